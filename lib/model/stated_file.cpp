#include "model/stated_file.h"

#include "model/names.h"

namespace gainsmith::model {

std::string quoted(const std::string& word) {
  const bool plain = word.find_first_not_of(
                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                         "_-./+,:@%=") == std::string::npos;
  if (plain && !word.empty() && word.front() != '=') return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string problem_words(const std::string& file, const std::vector<Setting>& settings) {
  std::string text = quoted(file);
  for (const Setting& setting : settings)
    if (setting.name != kSearch) text += " --set " + quoted(setting.name + "=" + setting.value);
  return text;
}

}  // namespace gainsmith::model
