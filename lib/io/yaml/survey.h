// Internal to io: a first pass over the events of a YAML file, before its nodes are made.
#pragma once

#include <yaml-cpp/eventhandler.h>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/stop.h"

namespace gainsmith::io {

/// Where documents start. Refuses aliases that what reads the nodes would never, or hardly, come to
/// the end of: an alias is the whole list or mapping again.
class Survey : public YAML::EventHandler {
 public:
  using Refuse = std::function<void(const YAML::Mark&, const std::string& message)>;

  explicit Survey(Refuse refuse) : refuse_(std::move(refuse)) {}

  std::vector<YAML::Mark> starts;

  void OnDocumentStart(const YAML::Mark& mark) override { starts.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { leaf(anchor); }
  /// An alias counts as many values as its anchor has, so repeated doubling is seen at once.
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const std::size_t nodes = nodes_[anchor];
    if (nodes == 0) refuse_(mark, "this alias is part of what it stands for");
    if ((aliased_ += nodes) > kMostAliased)
      refuse_(mark, "the aliases up to here stand for more than " + std::to_string(kMostAliased) +
                        " values");
    open_.back().nodes += nodes;
  }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    check_stop();
    leaf(anchor);
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open_.push_back({anchor});
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open_.push_back({anchor});
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or mapping that is being read.
  struct Open {
    YAML::anchor_t anchor = 0;
    std::size_t nodes = 1;  ///< with those of aliases, so far
  };

  void leaf(YAML::anchor_t anchor) {
    open_.push_back({anchor});
    close();
  }
  void close() {
    const Open node = open_.back();
    open_.pop_back();
    if (node.anchor != 0) nodes_[node.anchor] = node.nodes;
    open_.back().nodes += node.nodes;
  }

  /// Values that aliases of a file may repeat in all: a few short lines could ask for billions.
  static constexpr std::size_t kMostAliased = 100'000;

  Refuse refuse_;
  std::vector<Open> open_ = {{}};                ///< the first holds the documents
  std::map<YAML::anchor_t, std::size_t> nodes_;  ///< 0 of what is still open
  std::size_t aliased_ = 0;
};

}  // namespace gainsmith::io
