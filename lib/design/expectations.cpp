#include "design/expectations.h"

#include <algorithm>

#include "base/number.h"
#include "design/results.h"

namespace gainsmith::design {

namespace {

std::string text_of(const numbers::Matrix& matrix) {
  std::string text;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (i > 0) text += "; ";
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += (j > 0 ? ", " : "") + brief(matrix(i, j), 9);
  }
  return matrix.size() == 1 ? text : "[" + text + "]";
}

std::string listed(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

/// Collects the differences, one sentence each.
class Comparison {
 public:
  Comparison(const model::Instance& instance, const model::Gains& gains)
      : gains_(gains), results_(instance, gains) {}

  void words(const std::string& what, const std::optional<std::string>& expected,
             const std::string& found, const Place& place) {
    if (expected && *expected != found) add(place, what, *expected, found);
  }

  /// What a problem has to be when it does not say otherwise.
  void usual(const std::string& what, const std::string& wanted, const std::string& found,
             const Place& place) {
    add(place, what, wanted + " (no 'expect' says otherwise)", found);
  }

  /// A value within max(absolute, relative |expected|) of the expected one, at most, or at least.
  void value(const model::Design::ExpectedValue& expected) {
    const auto value = results_.value(expected.what);
    if (!value) return add(expected.place, expected.name, "a value", "none");
    if (expected.value) near(expected, *value);
    if (expected.below) within(expected, *expected.below, "at most ", 1, *value);
    if (expected.above) within(expected, *expected.above, "at least ", -1, *value);
  }

  void bounds(const std::vector<std::string>& expected, const Place& place) {
    std::vector<std::string> active;
    for (const model::GainBound& bound : gains_.bounds)
      if (bound.active) active.push_back(bound.what);
    if (listed(active) != listed(expected))
      add(place, "active bounds", listed(expected), listed(active));
  }

  std::vector<std::string> take() { return std::move(differences_); }

 private:
  using Expected = model::Design::ExpectedValue;

  void near(const Expected& expected, const numbers::Matrix& found) {
    const numbers::Matrix wanted = results_.value(*expected.value).value();
    double allowed = expected.absolute.value_or(0);
    if (expected.relative)
      allowed = std::max(allowed, *expected.relative * wanted.cwiseAbs().maxCoeff());
    Eigen::Index row = 0, column = 0;
    const double difference = (found - wanted).cwiseAbs().maxCoeff(&row, &column);
    if (difference <= allowed) return;
    add(expected.place, expected.name, text_of(wanted) + " within " + brief(allowed),
        text_of(found) + most_at(found, ", most different at ", row, column));
  }

  /// Of each element sign*found <= sign*bound.
  void within(const Expected& expected, const model::Formula& bound, const std::string& word,
              double sign, const numbers::Matrix& found) {
    const numbers::Matrix limit = results_.value(bound).value();
    Eigen::Index row = 0, column = 0;
    if ((sign * (found - limit)).maxCoeff(&row, &column) <= 0) return;
    add(expected.place, expected.name, word + text_of(limit),
        text_of(found) + most_at(found, ", farthest from it at ", row, column));
  }

  /// Empty of a number.
  static std::string most_at(const numbers::Matrix& found, const std::string& words,
                             Eigen::Index row, Eigen::Index column) {
    if (found.size() == 1) return "";
    return words + "(" + std::to_string(row + 1) + ", " + std::to_string(column + 1) + ")";
  }

  void add(const Place& place, const std::string& what, const std::string& expected,
           const std::string& found) {
    differences_.push_back(to_string(place) + ": " + what + ": expected " + expected + ", found " +
                           found);
  }

  const model::Gains& gains_;
  Results results_;
  std::vector<std::string> differences_;
};

}  // namespace

bool lacks_gains(const model::Design& design, const model::Gains& gains) {
  const auto& expect = design.expect;
  const std::string wanted = expect && expect->verdict ? *expect->verdict : "yes";
  return gains.verdict != model::Verdict::yes && to_string(gains.verdict) != wanted;
}

std::vector<std::string> differences(const model::Instance& instance, const model::Gains& gains,
                                     std::optional<model::CampaignVerdict> campaign) {
  const auto& expect = instance.design->expect;
  Comparison comparison(instance, gains);
  const Place whole{instance.design->file};
  const bool is_no = gains.verdict == model::Verdict::no;
  if (is_no && !(expect && expect->verdict)) comparison.usual("verdict", "yes", "no", whole);
  if (expect) comparison.words("verdict", expect->verdict, to_string(gains.verdict), expect->place);
  if (lacks_gains(*instance.design, gains)) return comparison.take();
  const bool is_violated = campaign == model::CampaignVerdict::violated;
  if (is_violated && !(expect && expect->campaign))
    comparison.usual("campaign", "held", "violated", whole);
  if (!expect) return comparison.take();
  comparison.words("status", expect->status, gains.solver.status, expect->place);
  comparison.words("campaign", expect->campaign, campaign ? to_string(*campaign) : "no campaign",
                   expect->place);
  if (expect->active_bounds) comparison.bounds(*expect->active_bounds, expect->place);
  for (const model::Design::ExpectedValue& value : expect->values) comparison.value(value);
  return comparison.take();
}

}  // namespace gainsmith::design
