#include "gainsmith/part_file.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/isa.h"
#include "base/version.h"
#include "gainsmith/sealed.h"
#include "gainsmith/terminal.h"

namespace gainsmith::app {

namespace {

constexpr const char* kWhat =
    "a part that --shard of 'gainsmith verify' or 'gainsmith scan' writes";

const char* name_of_part(PartKind kind) { return kind == PartKind::campaign ? "campaign" : "scan"; }

std::string said(const io::Json& statement, const std::string& key) {
  const auto found = statement.find(key);
  if (found == statement.end()) return "none";
  if (found->is_string() && !found->get<std::string>().empty()) return found->get<std::string>();
  if (found->empty() || found->is_string()) return "none";
  return io::is_number(*found) ? io::decimal_of(*found) : found->dump();
}

}  // namespace

io::Json begin_statement(const char* kind) {
  // Machines without fused products round otherwise.
  return {{"gainsmith", kVersion},
          {"machine", isa() == "v2" ? "without fused products" : "with fused products"},
          {kWork, kind}};
}

io::Json part_head(PartKind kind, const Shard& shard, const io::Json& statement) {
  return {{"part", name_of_part(kind)}, {"shard", to_text(shard)}, {"statement", statement}};
}

io::Json read_part(const std::string& file) {
  io::Json document = unsealed(read_text(file), file, kWhat);
  if (!document.contains("part") || !document.contains("statement"))
    throw InputError({file}, std::string("expected ") + kWhat);
  const std::string version = document["statement"].value("gainsmith", "");
  if (version != kVersion)
    throw InputError({file}, "this part was made by gainsmith " + version + ", and this is " +
                                 kVersion + ": make it again");
  return document;
}

PartKind kind_of(const io::Json& part) {
  return part.value("part", "") == name_of_part(PartKind::scan) ? PartKind::scan
                                                                : PartKind::campaign;
}

Shard shard_of(const io::Json& part) { return parse_shard(part.value("shard", "")); }

void require_same_work(const io::Json& part, const std::string& file, const io::Json& first,
                       const std::string& first_file) {
  if (kind_of(part) != kind_of(first))
    throw InputError(
        {file}, fmt::format("this is a part of a {}, and {} one of a {}",
                            name_of_part(kind_of(part)), first_file, name_of_part(kind_of(first))));
  std::string different = difference_of(part.at("statement"), first.at("statement"));
  if (different.starts_with("gains_sha256"))
    different = fmt::format("other gains, {}", part.value("source", ""));
  if (different.starts_with("problem_sha256"))
    different = "another text of the problem, or other values of --set";
  if (!different.empty())
    throw InputError({file}, fmt::format("this part is of another {} than {}: {}",
                                         name_of_part(kind_of(part)), first_file, different));
}

std::string difference_of(const io::Json& found, const io::Json& expected) {
  for (const io::Json* one : {&expected, &found})
    for (const auto& item : one->items()) {
      const std::string a = said(found, item.key()), b = said(expected, item.key());
      if (a != b) return item.key() + " " + a + ", not " + b;
    }
  return "";
}

void require_part_name(const std::string& shard, const std::string& output) {
  if (!shard.empty() && output.empty())
    throw InputError({},
                     "--shard needs -o FILE, where the part is written (- for standard output)");
}

void write_part(const io::Json& document, const std::string& output, const std::string& what) {
  const Telling telling;
  if (output == "-") {
    fmt::print("{}", sealed(document));
    return;
  }
  write_atomically(output, sealed(document));
  say(fmt::format("wrote {}: part {}, {}\n", output, to_text(shard_of(document)), what));
}

void say_unwritten(const Shard& shard, const std::string& done) {
  const Telling telling;
  say(fmt::format("interrupted after {} of part {}: it was not written\n", done, to_text(shard)));
}

}  // namespace gainsmith::app
