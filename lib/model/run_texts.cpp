#include "model/run_texts.h"

#include "model/dynamics_programs.h"

namespace gainsmith::model {

namespace {

/// Replaces calls by the bodies of the functions.
class Linking {
 public:
  explicit Linking(const Bodies& bodies) : bodies_(&bodies) {}

  void operator()(expr::Program& program) const { program = bodies_->link(program); }
  void operator()(Formula& formula) const { (*this)(formula.program); }
  void operator()(std::optional<Formula>& formula) const {
    if (formula) (*this)(*formula);
  }
  void operator()(std::vector<Formula>& formulas) const {
    for (Formula& formula : formulas) (*this)(formula);
  }

 private:
  const Bodies* bodies_;
};

void link_dynamics(const Linking& link, Dynamics& dynamics) {
  for_each_run_program(dynamics, [&](expr::Program& program, const Place&) { link(program); });
  for (Dynamics::Variable& variable : dynamics.variables) link(variable.start);
  for (Dynamics::Event& event : dynamics.events) {
    for (auto* one : {&event.low, &event.high, &event.first_low, &event.first_high}) link(*one);
    link(event.times);
  }
  for (Dynamics::Reaction& reaction : dynamics.reactions)
    for (Dynamics::Pass& pass : reaction.passes) link(pass.at_most);
  for (Dynamics::Noise& noise : dynamics.noise) {
    link(noise.values);
    link(noise.every);
  }
  for (Dynamics::Signal& signal : dynamics.signals) link(signal.value);
}

void link_campaign(const Linking& link, Design::Campaign& campaign) {
  link(campaign.horizon);
  link(campaign.first);
  for (Design::Law& law : campaign.laws) link(law.values);
  for (Design::Start& start : campaign.starts) link(start.values);
}

void link_claim(const Linking& link, Design::Claim& claim) {
  link(claim.value);
  for (auto* one : {&claim.flow_cost, &claim.jump_cost, &claim.factor, &claim.bound, &claim.after})
    link(*one);
}

/// The integral of a flow cost: 1 x 1, 0 at the start.
void add_cost(const Design::Claim& claim, Dynamics& dynamics) {
  expr::Composer compose(claim.place);
  Dynamics::Variable variable;
  variable.name = cost_name(claim.name);
  variable.start = {compose.take(compose.number("0")), claim.place, "0"};
  variable.place = claim.place;
  dynamics.variables.push_back(std::move(variable));
}

}  // namespace

std::string cost_name(const std::string& claim) { return "cost of " + claim; }

RunTexts run_texts(const Design& design, Stated stated) {
  const Place method{design.method_file, 0, 0};
  if (!design.dynamics) throw InputError(method, "there are no events and no components to run");
  RunTexts texts{method, std::move(stated), *design.dynamics, design.campaign, design.claims};
  const Linking link(texts.stated.bodies);
  link_dynamics(link, texts.dynamics);
  link_campaign(link, texts.campaign);
  for (Design::Claim& claim : texts.claims) {
    link_claim(link, claim);
    if (claim.kind == ClaimKind::cost) add_cost(claim, texts.dynamics);
  }
  return texts;
}

}  // namespace gainsmith::model
