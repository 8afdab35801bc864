// The results of one problem on a page: verdict and what it rests on, gains, margins, certificate,
// campaign, provenance.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/campaign_record.h"
#include "model/gains.h"
#include "model/problem.h"

namespace gainsmith::page {

/// A picture of linear systems that the problem asks for.
struct SystemFigure {
  std::string title;
  std::string svg;                 ///< empty: the facts say why
  std::vector<std::string> facts;  ///< sentences
};

/// Everything that a page says of one problem. Sentences are plain text.
struct Results {
  std::string name;   ///< in the table: the folder, or the name of the problem
  std::string error;  ///< why there are none, or no more than the gains; empty: there are
  model::Gains gains;
  std::optional<model::Problem> problem;  ///< as stated
  std::string unreadable;                 ///< why the statement is shown as text alone
  std::optional<model::CampaignRecord> campaign;
  std::string no_campaign;  ///< why there is none

  // In the words of the other commands.
  std::string mark;            ///< "ok", "NO": after `run`; empty otherwise
  std::string verdict_line;    ///< "yes, objective 688.572"
  std::string solver_line;     ///< why the solver stopped
  std::string objective_line;  ///< with the price of margins
  std::string search_lines;    ///< one line each
  std::string campaign_line;   ///< "held in 1000 runs, worst run 627"

  bool expects = false;                  ///< whether `expect:` was compared
  std::vector<std::string> differences;  ///< from what is expected
  bool changed = false;                  ///< the gain file is not the one that was run
  std::optional<double> seconds;         ///< of everything
  std::string picture;                   ///< SVG; empty with a title: left out of a large page
  std::string picture_title;             ///< "Run 627 of seed 1"
  std::vector<SystemFigure> figures;
  std::vector<std::pair<std::string, std::string>> files;  ///< name and SHA-256
};

/// The sections of a problem, without its name: markup.
std::string sections(const Results& results);

/// Pictures with their titles and facts.
std::string figures_of(const std::vector<SystemFigure>& figures);

/// The campaign: claims, confidence, how to see the worst runs again. Empty when there is none and
/// nothing says why.
std::string campaign_section(const Results& results);

}  // namespace gainsmith::page
