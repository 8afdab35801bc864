// The section of a campaign: its verdict, a row for each claim, and how to repeat the worst runs.
#include <algorithm>

#include "base/number.h"
#include "page/element.h"
#include "page/results.h"

namespace gainsmith::page {

namespace {

/// A violated run counts more than an undecided one; "held" is said of what was sampled.
std::string verdict_of(const model::ClaimRecord& check) {
  if (!check.stated) return "not stated";
  if (!check.sampled) return "never checked";
  if (check.violations > 0) return "violated in " + count_of(check.violations, "run");
  if (check.undecided > 0) return "undecided in " + count_of(check.undecided, "run");
  return "held";
}

/// A number, or a dash for none.
std::string shown(const std::optional<double>& value) { return value ? brief(*value) : "\u2014"; }

/// A row; of a claim that is not stated the data that it lacks.
std::string claim_line(const model::ClaimRecord& check) {
  std::string line;
  const auto add = [&](const std::string& text) { line += text_element("td", text); };
  add(check.name);
  add(check.kind);
  add(verdict_of(check));
  if (check.stated && check.sampled) {
    add(std::to_string(check.worst_run));
    add(shown(check.worst.value));
    add(shown(check.worst.bound));
    add(brief(check.worst.t) + ", " + std::to_string(check.worst.j));
  } else {
    std::string missing;
    for (const std::string& name : check.missing)
      missing += (missing.empty() ? "no value for " : ", ") + name;
    line += text_element("td", missing, "colspan=\"4\"");
  }
  // Such a row has the colour of a no.
  const bool bad = check.violations > 0 || check.undecided > 0;
  return element("tr", line, bad ? "class=\"bad\"" : "");
}

std::string claims_table(const model::CampaignRecord& campaign) {
  if (campaign.checks.empty()) return "";
  std::string lines;
  for (const model::ClaimRecord& check : campaign.checks) lines += claim_line(check);
  return headed_table({"claim", "", "", "worst run", "value", "bound", "(t, j)"}, lines);
}

/// The bound on the probability of a violation, and its confidence. Nothing where it says nothing.
std::string confidence_text(const model::CampaignRecord& campaign) {
  if (campaign.different_runs)
    return "Nothing is drawn at random: no run says anything of another.";
  if (!campaign.violation_probability || !campaign.confidence ||
      *campaign.violation_probability >= 1)
    return "";
  return "With " + brief(100 * *campaign.confidence) + " % confidence at most " +
         brief(*campaign.violation_probability, 3) +
         " of such runs violate. This is evidence, no proof.";
}

/// The runs that are worth examining, each once, the worst first.
std::vector<std::uint64_t> worst_runs(const model::CampaignRecord& campaign) {
  std::vector<std::uint64_t> runs = {campaign.worst_run};
  const auto add = [&](std::uint64_t run) {
    if (std::find(runs.begin(), runs.end(), run) == runs.end()) runs.push_back(run);
  };
  for (const model::ClaimRecord& check : campaign.checks)
    if (check.stated && check.sampled) add(check.worst_run);
  if (campaign.first_unfinished) add(campaign.first_unfinished->run);
  if (campaign.first_undecided) add(campaign.first_undecided->run);
  return runs;
}

/// Commands that repeat the worst runs and draw them.
std::string replay_text(const model::CampaignRecord& campaign) {
  std::string commands;
  for (const std::uint64_t run : worst_runs(campaign))
    commands += "gainsmith simulate gains.json --seed " + std::to_string(campaign.seed) +
                " --run " + std::to_string(run) + " --plot run-" + std::to_string(run) + ".svg\n";
  return text_element("p", "The worst runs, or those nearest to a violation, again:") +
         preformatted(commands);
}

}  // namespace

/// The verdict of a page is yes, no or undecided; a campaign held, is violated or is undecided.
std::string campaign_section(const Results& results) {
  if (!results.campaign)
    return results.no_campaign.empty()
               ? ""
               : section("Campaign", text_element("p", "None: " + results.no_campaign));
  const model::CampaignRecord& campaign = *results.campaign;
  const std::string verdict = campaign.verdict == model::CampaignVerdict::held       ? "yes"
                              : campaign.verdict == model::CampaignVerdict::violated ? "no"
                                                                                     : "undecided";
  std::string text = text_element("p", results.campaign_line, "class=\"verdict " + verdict + "\"");
  text += text_element("p", "Seed " + std::to_string(campaign.seed) + ", horizon " +
                                brief(campaign.horizon) + ". " + confidence_text(campaign));
  text += claims_table(campaign);
  if (campaign.first_unfinished)
    text += text_element("p", count_of(campaign.unfinished, "run") +
                                  " did not reach the horizon; run " +
                                  std::to_string(campaign.first_unfinished->run) + ": " +
                                  campaign.first_unfinished->why);
  if (campaign.first_undecided)
    text += text_element("p", count_of(campaign.undecided, "run") + " undecided; first run " +
                                  std::to_string(campaign.first_undecided->run) + ": " +
                                  campaign.first_undecided->why);
  if (campaign.repeated > 0)
    text += text_element("p", count_of(campaign.repeated, "run") + " repeated more accurately; " +
                                  std::to_string(campaign.confirmed.size()) + " violated again.");
  for (const std::string& note : campaign.notes) text += text_element("p", "Note: " + note + ".");
  return section("Campaign", text + replay_text(campaign));
}

}  // namespace gainsmith::page
