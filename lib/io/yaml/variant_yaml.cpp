// Joining a problem with the one that it is `like`, as trees of nodes, before any key is read.
//
// The other problem is completed first, so a chain is joined from its end. A mapping that is joined
// (is_joined) takes each entry of the other one that it does not replace or remove by `none`; any
// other value is replaced as a whole. The result has the nodes of both files, each with its place.
#include "io/yaml/variant_yaml.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/named.h"
#include "base/nearest.h"
#include "io/sources.h"
#include "io/yaml/yaml_names.h"
#include "model/words.h"

namespace gainsmith::io {

namespace {

/// The keys that lead to a node.
using KeyPath = std::vector<std::string>;

/// method.plant, method.observer, or one of method.observers.
bool is_component(const KeyPath& path) {
  if (path.size() < 2 || path[0] != "method") return false;
  return path.size() == 2 ? path[1] == "plant" || path[1] == "observer"
                          : path.size() == 3 && path[1] == "observers";
}

/// Whether a mapping is joined with the other one's, entry by entry.
bool is_joined(const KeyPath& path) {
  constexpr auto kNested = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"search", "over"}, {"campaign", "initial"}, {"expect", "values"}});
  const KeyPath above(path.begin(), path.end() - 1);
  if (is_component(above)) return path.back() != "while";
  if (path.size() != 2) return path.size() == 1 || is_component(path);
  return path[0] == "method" || std::any_of(kNested.begin(), kNested.end(), [&](const auto& keys) {
           return keys.first == path[0] && keys.second == path[1];
         });
}

/// One entry of a mapping.
struct VariantEntry {
  YAML::Node key;
  YAML::Node value;
  std::string name;
};
using Entries = std::vector<VariantEntry>;

/// "f" of a key "f(x)" where keys have parameters.
std::string name_of_key(const std::string& key, const KeyPath& path) {
  const bool signatures =
      !path.empty() && (path.back() == "let" || path.back() == "data" || path.back() == "gains");
  return signatures ? key.substr(0, key.find('(')) : key;
}

/// How often the name is a key below the node.
int count_keys(const YAML::Node& node, const std::string& name) {
  int count = 0;
  for (const auto& entry : node) {
    if (node.IsMap())
      count += (entry.first.IsScalar() && entry.first.Scalar() == name ? 1 : 0) +
               count_keys(entry.second, name);
    else
      count += count_keys(entry, name);
  }
  return count;
}

/// Completes one problem. `open_` has the files that are being completed, to find circles.
class Variant {
 public:
  explicit Variant(YamlFile& file) : file_(file) {
    open_.push_back(std::filesystem::path(file.file()).filename().string());
  }

  /// The root joined with the problem that it is like; the root itself where it is like none.
  YAML::Node whole(const YAML::Node& root) {
    if (!root.IsMap() || !root["like"]) return root;
    const YAML::Node like = root["like"];
    const Reference reference{file_.named_by(like, file_.string(like, "like")), "like",
                              file_.place(like)};
    refuse_circle(reference);
    open_.push_back(reference.name);
    Sources& sources = file_.sources(like);
    const std::string shown = sources.shown(reference.name);
    // The other one first takes what it is like: `other_` and `root_` are set after it.
    const YAML::Node other = whole(file_.add(sources.problem(reference), shown, reference.name));
    if (other.IsMap() && other["gainsmith"])
      throw InputError(reference.place, "like: " + shown + " is a gain file; expected a problem");
    other_ = shown;
    root_.reset(root);
    method_goes_on_ =
        other.IsMap() && other["method"] && other["method"].IsMap() && other["method"]["like"];
    return joined(root, other, {}, false);
  }

  /// The problem, whose method takes what it has not from the one that it is `like`.
  YAML::Node with_whole_method(const YAML::Node& root, const MethodLibrary& library) {
    if (!root.IsMap() || !root["method"] || !root["method"].IsMap() || !root["method"]["like"])
      return root;
    const YAML::Node own = root["method"];
    const YAML::Node like = own["like"];
    const std::string name = file_.string(like, "like");
    other_ = model::method_file(name);
    method_goes_on_ = false;
    const auto text =
        file_.sources(like).method({other_, "like", file_.place(like)}, library.text(name));
    if (!text) throw InputError(file_.place(like), unknown_method(name, library.names));
    root_.reset(root);
    // What is only of the other one: its name, and its place in the list of methods.
    const YAML::Node other =
        without(file_.add(*text, other_, other_), {"method", "task", "example"});
    const YAML::Node method = joined(without(own, {"like"}), other, {"method"}, false);
    std::vector<std::pair<YAML::Node, YAML::Node>> entries;
    for (const auto& entry : root)
      entries.emplace_back(entry.first, entry.first.Scalar() == "method" ? method : entry.second);
    return file_.mapping(entries, file_.place(root));
  }

 private:
  /// The mapping without the entries of these names.
  YAML::Node without(const YAML::Node& node, const std::vector<std::string>& names) {
    std::vector<std::pair<YAML::Node, YAML::Node>> kept;
    for (const VariantEntry& entry : entries_of(node, {"method"}))
      if (std::find(names.begin(), names.end(), entry.name) == names.end())
        kept.emplace_back(entry.key, entry.value);
    return file_.mapping(kept, file_.place(node));
  }

  /// InputError for a problem that is like itself by others, and for a chain of more than 20.
  void refuse_circle(const Reference& reference) const {
    constexpr std::size_t kMost = 20;
    const bool circle = std::find(open_.begin(), open_.end(), reference.name) != open_.end();
    if (!circle && open_.size() <= kMost) return;
    std::string chain;
    for (const std::string& name : open_) chain += name + ", which is like ";
    throw InputError(reference.place,
                     circle ? "like: this leads back to itself: " + chain + reference.name
                            : "like: more than " + std::to_string(kMost) + " problems in a row");
  }

  /// The entries of a mapping with the names by which they replace each other.
  Entries entries_of(const YAML::Node& node, const KeyPath& path) const {
    // Two keys of one name are refused.
    const YamlMap map(file_, node, path.empty() ? "problem" : path.back());
    Entries entries;
    for (const auto& entry : node)
      entries.push_back({entry.first, entry.second, name_of_key(entry.first.Scalar(), path)});
    return entries;
  }

  /// `keeps_none`: of a part of a component that is like another one, which takes "none" for what
  /// that one has.
  YAML::Node joined(const YAML::Node& own, const YAML::Node& other, const KeyPath& path,
                    bool keeps_none) {
    const Entries mine = entries_of(own, path);
    const Entries theirs = entries_of(other, path);
    const bool like = is_component(path) && (has_named(mine, "like") || has_named(theirs, "like"));
    // What is taken away may be of the built-in method too, which comes in later.
    const bool later = method_goes_on_ && !path.empty() && path[0] == "method";
    std::vector<std::pair<YAML::Node, YAML::Node>> result;
    for (const VariantEntry& entry : theirs) {
      if (path.empty() && is_own(entry.name)) continue;
      const VariantEntry* replaced = find_named(mine, entry.name);
      if (replaced == nullptr) {
        result.emplace_back(entry.key, entry.value);
      } else if (keeps_none || !takes_away(*replaced, path)) {
        result.emplace_back(replaced->key, one(*replaced, entry, path, like));
      } else if (later) {
        taken_.push_back(path_of(path, entry.name));
        result.emplace_back(replaced->key, replaced->value);
      }
    }
    for (const VariantEntry& entry : mine) {
      if (path.empty() && is_own(entry.name)) {
        if (entry.name != "like" && !is_none(entry.value))
          result.emplace_back(entry.key, entry.value);
        continue;
      }
      if (has_named(theirs, entry.name)) continue;
      if (takes_away(entry, path) && !keeps_none && was_taken(path_of(path, entry.name))) continue;
      if (takes_away(entry, path) && !keeps_none && !later)
        throw InputError(file_.place(entry.value),
                         "there is no '" + entry.name + "' in " + other_ + " to be taken away" +
                             suggestion(entry.name, names_of_all(theirs)));
      refuse_misspelling(entry, theirs, path);
      result.emplace_back(entry.key, method_goes_on_
                                         ? entry.value
                                         : without_taken(entry.value, path_of(path, entry.name)));
    }
    return file_.mapping(result, file_.place(own));
  }

  /// The path of an entry below a path.
  static KeyPath path_of(KeyPath path, const std::string& name) {
    path.push_back(name);
    return path;
  }

  /// Whether `none` removed what has this path from the other problem.
  bool was_taken(const KeyPath& path) const {
    return std::find(taken_.begin(), taken_.end(), path) != taken_.end();
  }

  /// A part that the built-in method has nothing of, less what was taken away.
  YAML::Node without_taken(const YAML::Node& node, const KeyPath& path) {
    const bool holds = std::any_of(taken_.begin(), taken_.end(), [&](const KeyPath& taken) {
      return taken.size() > path.size() && std::equal(path.begin(), path.end(), taken.begin());
    });
    if (!holds || !node.IsMap()) return node;
    std::vector<std::pair<YAML::Node, YAML::Node>> kept;
    for (const VariantEntry& entry : entries_of(node, path)) {
      const KeyPath below = path_of(path, entry.name);
      if (!is_none(entry.value) || !was_taken(below))
        kept.emplace_back(entry.key, without_taken(entry.value, below));
    }
    return file_.mapping(kept, file_.place(node));
  }

  /// The value that takes the place of another one.
  YAML::Node one(const VariantEntry& mine, const VariantEntry& theirs, const KeyPath& path,
                 bool keeps_none) {
    KeyPath below = path;
    below.push_back(theirs.name);
    if (mine.value.IsMap() && theirs.value.IsMap() && is_joined(below))
      return joined(mine.value, theirs.value, below, keeps_none);
    // A section without entries changes none, and a claim without entries is the other one's.
    if (mine.value.IsNull() && theirs.value.IsMap() && is_joined(below)) return theirs.value;
    if (path == KeyPath{"method", "claims"} && theirs.value.IsMap() && mine.value.IsMap() &&
        mine.value.size() == 0)
      return theirs.value;
    if (below == KeyPath{"method"}) refuse_change(mine, theirs);
    return mine.value;
  }

  /// InputError for changes of a method that the other problem only names.
  void refuse_change(const VariantEntry& mine, const VariantEntry& theirs) const {
    const bool whole = !mine.value.IsMap() || mine.value["like"] || mine.value["data"] ||
                       mine.value["require"] || mine.value["plant"] || mine.value["report"];
    if (whole || !theirs.value.IsScalar()) return;
    const std::string& name = theirs.value.Scalar();
    throw InputError(file_.place(mine.value),
                     other_ + " names its method, '" + name +
                         "', and has no text of it; to change it, write 'method: {like: " + name +
                         ", ...}'");
  }

  /// What a problem does not take from another one.
  static bool is_own(const std::string& key) {
    return key == "problem" || key == "expect" || key == "like";
  }

  /// "gain_bound: none" means that there is no bound.
  static bool takes_away(const VariantEntry& entry, const KeyPath& path) {
    return is_none(entry.value) && (path.empty() || path[0] != "synthesis");
  }

  /// InputError for what is new here, and is likely to be a misspelling of what is there: no text
  /// of this file reads it, or it is an observer without a state.
  void refuse_misspelling(const VariantEntry& entry, const Entries& theirs,
                          const KeyPath& path) const {
    if (path.empty()) return;
    const std::string& section = path.back();
    const bool of_method = path.size() == 2 && path[0] == "method";
    const bool is_observer = of_method && section == "observers";
    // What is read by nothing has no effect, so its name is likely a slip.
    const bool must_be_read =
        section == "let" ||
        (of_method && (section == "inputs" || section == "noise" || section == "events"));
    if (!must_be_read && !is_observer) return;
    if (is_observer && (!entry.value.IsMap() || entry.value["state"] || entry.value["like"]))
      return;
    if (must_be_read && (is_read(root_, entry.name) || count_keys(root_, entry.name) > 1)) return;
    if (const auto near = nearest(entry.name, names_of_all(theirs)))
      throw InputError(file_.place(entry.key),
                       "'" + entry.name + "' is not in " + other_ +
                           (is_observer ? ", and has no state" : ", and nothing reads it") +
                           "; did you mean '" + *near + "'?");
  }

  YamlFile& file_;
  YAML::Node root_;                ///< of the problem that is like another one
  std::string other_;              ///< the file of that one
  bool method_goes_on_ = false;    ///< its method is like a built-in one, which has more entries
  std::vector<KeyPath> taken_;     ///< what was taken from that one
  std::vector<std::string> open_;  ///< the problem, what it is like, and so on
};

}  // namespace

YAML::Node with_what_it_is_like(YamlFile& file, const MethodLibrary& library) {
  Variant variant(file);
  return variant.with_whole_method(variant.whole(file.root()), library);
}

}  // namespace gainsmith::io
