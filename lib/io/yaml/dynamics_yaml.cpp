// Plant, observers, events, inputs and noise. The short form of a method with one clock, `timer`
// and `jump`, becomes an event and what components do at it: other rooms know events alone.
#include "io/yaml/dynamics_yaml.h"

#include <utility>

#include "expr/text/parser.h"
#include "io/yaml/component_yaml.h"
#include "io/yaml/measured_yaml.h"

namespace gainsmith::io {

namespace {

/// "tau: {reset: [T1, T2], first: [0, T2]}": the event {every: [T1, T2], first: [0, T2]}, with a
/// name for what is left of its clock. Without `first` the first value is drawn as from a reset.
model::EventText timer(const YamlFile& file, const YamlItem& item) {
  const auto items = items_of(file, item, "timer");
  if (items.size() != 1)
    throw InputError(item.place, "timer: expected one timer, such as 'tau: {reset: [T1, T2]}'");
  YamlMap map(file, items.front().value, items.front().key, keys::timer);
  const auto range = [&](const YamlItem& ends) {
    if (!ends.value.IsSequence() || ends.value.size() != 2)
      throw InputError(file.place(ends.value), ends.key + ": expected [low, high]");
    return one_or_two(file, ends);
  };
  model::EventText event;
  event.name = model::kTimerEvent;
  event.kind = model::Dynamics::EventKind::every;
  event.left = items.front().key;
  event.place = items.front().place;
  event.numbers = range(map.require("reset"));
  const auto first = map.find("first");
  event.first = first ? range(*first) : event.numbers;
  map.finish();
  return event;
}

/// "jump: {...}" of a component is what it does when the timer has run down.
void read_jump(model::Component& component, bool has_timer) {
  if (component.jump.empty()) return;
  const Place place = component.jump.front().place;
  if (!has_timer)
    throw InputError(place,
                     "jump: of a method with a timer; otherwise a jump is given under its event, "
                     "'at: {sample: {...}}'");
  model::PassText pass;
  pass.map = std::move(component.jump);
  pass.place = place;
  component.at.insert(component.at.begin(), {model::kTimerEvent, {std::move(pass)}, place});
  component.jump.clear();
}

/// "{amplitude: 0.1, frequency: [1, 2], phase: [0, 2*pi]}", each a value or [low, high].
void read_sinusoid(const YamlFile& file, const YamlItem& item, model::NoiseText& noise) {
  YamlMap map(file, item.value, "sinusoid", keys::sinusoid);
  const YamlItem amplitude = map.require("amplitude");
  const YamlItem frequency = map.require("frequency");
  const auto phase = map.find("phase");
  map.finish();
  for (const YamlItem& part : {amplitude, frequency})
    noise.sinusoid.emplace_back(part.key, one_or_two(file, part));
  if (phase) noise.sinusoid.emplace_back("phase", one_or_two(file, *phase));
  if (!phase)
    noise.sinusoid.emplace_back("phase",
                                std::vector{expr::parse(expr::Text::generated("0", item.place))});
}

/// "w: {normal: 0.03, new at: sample}", "w: {uniform: [-1, 1], every: 0.1}".
model::NoiseText noise(const YamlFile& file, const YamlItem& item) {
  using Kind = model::Dynamics::NoiseKind;
  constexpr const char* kForms =
      "expected {normal: deviation}, {uniform: [low, high]}, {lognormal: deviation} or {sinusoid: "
      "{amplitude: ..., frequency: ..., phase: ...}}";
  if (!item.value.IsMap()) throw InputError(item.place, "the noise '" + item.key + "': " + kForms);
  YamlMap map(file, item.value, item.key, keys::noise);
  model::NoiseText result;
  result.name = item.key;
  result.place = item.place;
  const auto around = spread(file, map, "0", "1");
  const auto uniform = map.find("uniform");
  const auto sinusoid = map.find("sinusoid");
  const auto event = map.find("new at");
  const auto every = map.find("every");
  map.finish();
  if (around.has_value() + uniform.has_value() + sinusoid.has_value() != 1)
    throw InputError(item.place, std::string("noise: ") + kForms);
  if (sinusoid && (event || every))
    throw InputError((event ? event : every)->place, "noise: a sinusoid is drawn once a run");
  if (sinusoid) read_sinusoid(file, *sinusoid, result);
  if (event && every)
    throw InputError(every->place, "noise: drawn anew at an event or every so often, not both");
  if (around) {
    for (const model::Value& value : around->values) result.values.push_back(value.value);
    result.kind = around->is_normal ? Kind::normal : Kind::lognormal;
    result.covariance = around->covariance;
  }
  if (uniform) {
    result.kind = Kind::uniform;
    result.values = one_or_two(file, *uniform);
    if (result.values.size() != 2)
      throw InputError(file.place(uniform->value), "uniform: expected [low, high]");
  }
  if (event) result.event = file.string(event->value, "new at");
  if (every) result.every = file.expression(every->value, "every");
  return result;
}

/// The only one of its kind, which is no family.
model::Component single(const YamlFile& file, const YamlItem& item,
                        std::vector<model::MeasuredText>* measured) {
  model::Component result = component(file, item, {}, measured);
  if (!result.indices.empty())
    throw InputError(result.indices.front().place,
                     "for: a family of observers is an entry of 'observers'");
  return result;
}

/// `observer` is first, then those of `observers`, each of which may be `like` one before it.
void read_observers(const YamlFile& file, const std::optional<YamlItem>& one,
                    const std::optional<YamlItem>& several, model::Method& method) {
  if (one) method.observers.push_back(single(file, *one, nullptr));
  if (!several) return;
  for (const YamlItem& item : items_of(file, several, "observers"))
    method.observers.push_back(component(file, item, method.observers));
}

/// The list of events of `order`.
std::vector<std::string> names(const YamlFile& file, const std::optional<YamlItem>& item) {
  std::vector<std::string> result;
  if (!item) return result;
  if (!item->value.IsSequence())
    throw InputError(item->place, item->key + ": expected a list of events");
  for (const auto& entry : item->value) result.push_back(file.string(entry, item->key));
  return result;
}

}  // namespace

void read_dynamics(const YamlFile& file, YamlMap& map, model::Method& method) {
  const auto plant = map.find("plant");
  const auto observer = map.find("observer");
  const auto observers = map.find("observers");
  const auto event_list = map.find("events");
  const auto order = map.find("order");
  const auto inputs = map.find("inputs");
  const auto noises = map.find("noise");
  if (plant) method.plant = single(file, *plant, &method.measured);
  method.plant.name = "plant";
  read_observers(file, observer, observers, method);
  const auto timer_item = map.find("timer");
  if (timer_item) method.events.push_back(timer(file, *timer_item));
  for (model::EventText& event : events(file, event_list, "events"))
    method.events.push_back(std::move(event));
  method.order = names(file, order);
  for (const YamlItem& item : items_of(file, inputs, "inputs"))
    if (is_measured(item))
      method.measured.push_back(measured_input(file, item));
    else
      method.inputs.push_back({item.key, matrix_of(file, item), item.place});
  for (const YamlItem& item : items_of(file, noises, "noise"))
    method.noise.push_back(noise(file, item));

  // The place of the first part that there is, in this order.
  for (const auto& item :
       {observers, event_list, order, inputs, noises, plant, observer, timer_item})
    if (item && method.dynamics_place.line == 0) method.dynamics_place = item->place;
  method.has_dynamics = method.dynamics_place.line > 0;
  read_jump(method.plant, timer_item.has_value());
  for (model::Component& component : method.observers) read_jump(component, timer_item.has_value());
}

}  // namespace gainsmith::io
