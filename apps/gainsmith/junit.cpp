#include "gainsmith/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gainsmith::app {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML has no control characters but these.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
          result += c;
        else
          result += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return result;
}

/// "NO: ...", where the words do not begin so.
std::string with_mark(const std::string& mark, const std::string& words) {
  const bool begins =
      words.size() > mark.size() && words[mark.size()] == ':' &&
      std::equal(mark.begin(), mark.end(), words.begin(),
                 [](unsigned char upper, char lower) { return std::tolower(upper) == lower; });
  return mark + (begins ? words.substr(mark.size()) : ": " + words);
}

std::string test_case(const JobResult& result) {
  std::string text =
      fmt::format("    <testcase classname=\"gainsmith\" name=\"{}\" time=\"{:.3f}\"",
                  escaped(result.name), result.seconds);
  if (result.exit == ExitCode::yes) return text + "/>\n";
  const std::string element = result.exit == ExitCode::no ? "failure" : "error";
  const std::string& cause = !result.causes.empty()        ? result.causes.front()
                             : !result.differences.empty() ? result.differences.front()
                                                           : result.line;
  std::string details = result.line;
  for (const std::string& one : result.causes) details += "\n" + one;
  for (const std::string& difference : result.differences) details += "\n" + difference;
  return text + fmt::format(">\n      <{0} message=\"{1}\">{2}</{0}>\n    </testcase>\n", element,
                            escaped(with_mark(mark_of(result.exit), cause)), escaped(details));
}

}  // namespace

std::string junit_text(const std::vector<JobResult>& results) {
  const auto failures = std::count_if(results.begin(), results.end(), [](const JobResult& result) {
    return result.exit == ExitCode::no;
  });
  const auto good = std::count_if(results.begin(), results.end(), [](const JobResult& result) {
    return result.exit == ExitCode::yes;
  });
  double seconds = 0;
  for (const JobResult& result : results) seconds += result.seconds;
  const auto errors = static_cast<std::ptrdiff_t>(results.size()) - failures - good;
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  text += fmt::format(
      "  <testsuite name=\"gainsmith run\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "time=\"{:.3f}\">\n",
      results.size(), failures, errors, seconds);
  for (const JobResult& result : results) text += test_case(result);
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace gainsmith::app
