#include "gainsmith/shard_option.h"

#include <optional>

#include "gainsmith/whole_number.h"

namespace gainsmith::app {

namespace {

constexpr std::uint64_t kMostShards = 1000000;

std::optional<Shard> shard_of_text(const std::string& text) {
  const std::size_t bar = text.find('/');
  if (bar == std::string::npos) return std::nullopt;
  const auto index = parse_whole(text.substr(0, bar));
  const auto of = parse_whole(text.substr(bar + 1));
  if (!index || !of || *index < 1 || *index > *of || *of > kMostShards) return std::nullopt;
  return Shard{*index, *of};
}

}  // namespace

Option shard_option(std::string& text, const std::string& what) {
  return Option("--shard", text, what)
      .named("I/N")
      .checked([](const std::string& given) -> std::string {
        if (shard_of_text(given)) return {};
        return "expected part/parts such as 3/8, from 1/8 to 8/8 and of 1000000 at most, not '" +
               given + "'";
      });
}

Shard parse_shard(const std::string& text) { return shard_of_text(text).value_or(Shard{}); }

std::string to_text(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.of);
}

}  // namespace gainsmith::app
