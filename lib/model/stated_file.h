// What a problem reads besides its own text, as a gain file states it.
#pragma once

#include <string>
#include <vector>

namespace gainsmith::model {

/// A matrix of a file, by its decimals.
struct StatedMatrix {
  std::string key;  ///< where it is in the file: "A", "plant.A"; empty where a file holds one
  int rows = 0;
  int cols = 0;
  std::vector<std::string> elements;  ///< row by row, spelt as in JSON
  bool flat = false;  ///< a list of numbers: a row, but a column where a column is declared
};

struct StatedFile {
  std::string name;                    ///< its path, from the folder of the problem on
  std::string sha256;                  ///< of its bytes
  std::string text;                    ///< of a problem that another one is `like`; otherwise empty
  std::vector<StatedMatrix> matrices;  ///< those that the problem takes from it
};

/// What the command line puts in the place of a value: "--set NAME=VALUE".
struct Setting {
  std::string name;
  std::string value;
};

/// A text as one word of a shell.
std::string quoted(const std::string& word);

/// "motor.yaml --set T2=0.8": a problem on a command line, with what was put in the place of its values.
std::string problem_words(const std::string& file, const std::vector<Setting>& settings);

}  // namespace gainsmith::model
