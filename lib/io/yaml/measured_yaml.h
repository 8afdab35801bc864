// Internal to io: measured data. Paths are relative to the file that names them.
//
//   {csv: run.csv, column: u, time: t, scale: 1, between: hold | line, rows: {event: sample},
//    from: 0}
//
// `time` is the column of the times, t unless said, in units of `scale` seconds. `rows`: those
// whose cells in these columns hold these words. `from`: the time in the file at which a run
// begins. Rows without a value (empty, NaN, NA) count for nothing.
#pragma once

#include <vector>

#include "io/yaml/yaml.h"
#include "model/method.h"

namespace gainsmith::io {

/// "u: {csv: ..., column: u, ...}".
model::MeasuredText measured_input(const YamlFile& file, const YamlItem& item);
/// Whether an input is a mapping, as those of files are, and not an expression.
bool is_measured(const YamlItem& input);

/// The times of an event, `at: {csv: log.csv, column: t, rows: ..., from: ...}`, from 0 on.
std::vector<double> measured_times(const YamlFile& file, const YamlItem& at);

/// Takes `log` and `output` of a plant that is a log, "{log: run.csv, output: {y: angle}}":
/// quantities and the outputs that show them.
void read_log(const YamlFile& file, YamlMap& plant, model::Component& component,
              std::vector<model::MeasuredText>& measured);

}  // namespace gainsmith::io
