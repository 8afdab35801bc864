#include "page/page.h"

#include <algorithm>

#include "base/number.h"
#include "base/version.h"
#include "page/element.h"
#include "page/style.h"

namespace gainsmith::page {

namespace {

/// The target of a link from the table, counted from 1.
std::string id_of(std::size_t k) { return "p" + std::to_string(k + 1); }

/// "yes", "no", "undecided", for the colour of a line of the table.
std::string colour_of(const Results& results) {
  if (!results.error.empty()) return "no";
  if (results.mark.empty()) return to_string(results.gains.verdict);
  return results.mark == "ok" ? "yes" : results.mark == "UNDECIDED" ? "undecided" : "no";
}

/// A row of the table of all problems; of one without results the error in its place.
std::string line_of(const Results& results, std::size_t k, bool marks) {
  std::string line;
  const auto add = [&](const std::string& text) { line += text_element("td", text); };
  if (marks) line += text_element("td", results.mark, "class=\"" + colour_of(results) + "\"");
  line += element("td", text_element("a", results.name, "href=\"#" + id_of(k) + "\""));
  if (!results.error.empty())
    return element("tr", line + text_element("td", results.error, "colspan=\"4\""));
  const model::Gains& gains = results.gains;
  add(gains.statement.method_name);
  line +=
      text_element("td", to_string(gains.verdict), "class=\"" + to_string(gains.verdict) + "\"");
  add(gains.objective ? brief(*gains.objective) : "");
  add(results.campaign ? results.campaign_line : "none");
  add(results.seconds ? brief(*results.seconds, 2) + " s" : "");
  return element("tr", line);
}

/// The table of all problems, with a column of marks where one has a mark.
std::string table_of(const std::vector<Results>& all) {
  const bool marks = std::any_of(all.begin(), all.end(),
                                 [](const Results& results) { return !results.mark.empty(); });
  std::vector<std::string_view> heads = {"problem", "method",   "verdict",
                                         "optimum", "campaign", "time"};
  if (marks) heads.insert(heads.begin(), "");
  std::string lines;
  for (std::size_t k = 0; k < all.size(); ++k) lines += line_of(all[k], k, marks) + "\n";
  return headed_table(heads, lines);
}

/// "118 problems: 90 yes, 20 no, 8 undecided"
std::string counts_of(const std::vector<Results>& all) {
  std::string text = count_of(all.size(), "problem") + ": ";
  std::string parts;
  const auto add = [&](const std::string& what, auto matches) {
    const auto count = std::count_if(all.begin(), all.end(), matches);
    if (count > 0) parts += (parts.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  for (const auto verdict : {model::Verdict::yes, model::Verdict::no, model::Verdict::undecided})
    add(to_string(verdict), [&](const Results& results) {
      return results.error.empty() && results.gains.verdict == verdict;
    });
  add("without results", [](const Results& results) { return !results.error.empty(); });
  return text + parts;
}

/// Values side by side, then the pictures of all designs in one.
std::string comparison_of(const Comparison& comparison) {
  std::vector<std::string_view> heads = {""};
  heads.insert(heads.end(), comparison.names.begin(), comparison.names.end());
  if (comparison.names.size() == 2) heads.emplace_back("difference");
  std::string lines;
  for (const Comparison::Row& row : comparison.rows) {
    std::string line = text_element("td", row.what);
    for (std::size_t k = 0; k + 1 < heads.size(); ++k) line += text_element("td", row.values[k]);
    lines += element("tr", line) + "\n";
  }
  return headed_table(heads, lines) + figures_of(comparison.figures);
}

/// The page: of several problems each is folded below the table.
std::string whole(const std::vector<Results>& all, const std::string& title,
                  const Comparison* comparison) {
  std::string body = text_element("h1", title) + "\n";
  if (comparison != nullptr) body += comparison_of(*comparison);
  if (all.size() == 1) {
    body += element("article", sections(all.front()));
  } else {
    body += text_element("p", counts_of(all)) + table_of(all);
    for (std::size_t k = 0; k < all.size(); ++k)
      body += element("details",
                      text_element("summary", all[k].name) +
                          element("article", sections(all[k]), "id=\"" + id_of(k) + "\""),
                      "class=\"problem\"") +
              "\n";
  }
  body += text_element("footer", std::string("gainsmith ") + kVersion);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"/>"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>" +
         text_element("title", title) + element("style", style) + "</head>\n" +
         element("body", body) + "\n</html>\n";
}

/// The largest pictures go until the page is smaller by `excess` bytes.
void leave_out_pictures(std::vector<Results>& all, std::size_t excess) {
  std::vector<Results*> order;
  for (Results& results : all) order.push_back(&results);
  std::stable_sort(order.begin(), order.end(), [](const Results* a, const Results* b) {
    return a->picture.size() > b->picture.size();
  });
  for (Results* results : order) {
    if (excess == 0 || results->picture.empty()) return;
    constexpr std::size_t kSentence = 300;  // that says so
    excess -=
        std::min(excess, results->picture.size() - std::min(results->picture.size(), kSentence));
    results->picture.clear();
  }
}

}  // namespace

/// The page is made twice where it is too large, the second time with fewer pictures.
std::string page(const std::vector<Results>& results, const std::string& title) {
  std::string text = whole(results, title, nullptr);
  if (results.size() == 1 || text.size() <= page_size) return text;
  std::vector<Results> lighter = results;
  leave_out_pictures(lighter, text.size() - page_size);
  return whole(lighter, title, nullptr);
}

std::string page(const std::vector<Results>& results, const std::string& title,
                 const Comparison& comparison) {
  return whole(results, title, &comparison);
}

}  // namespace gainsmith::page
