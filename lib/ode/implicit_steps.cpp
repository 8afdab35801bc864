#include "ode/implicit_steps.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "ode/tolerances.h"

namespace gainsmith::ode {

namespace cvode {

/// Frees what CVODE made.
template <auto free>
struct Freed {
  template <class T>
  void operator()(T* what) const {
    free(what);
  }
};
inline void free_context(SUNContext context) { SUNContext_Free(&context); }
inline void free_memory(void* memory) { CVodeFree(&memory); }
inline void free_solver(SUNLinearSolver solver) { SUNLinSolFree(solver); }

template <class Handle, auto free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Freed<free>>;
using Vector = Owned<N_Vector, N_VDestroy>;

template <class Pointer>
Pointer made(Pointer pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

/// The vector, and all that are made like it, add up several at once.
inline N_Vector fused(N_Vector vector) {
  N_VEnableFusedOps_Serial(vector, 1);
  return vector;
}

inline void require(int flag) {
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
  if (flag < 0) throw std::logic_error("CVODE: " + std::to_string(flag));
}

inline SUNContext new_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return context;
}

}  // namespace cvode

class ImplicitSteps::Solver {
 public:
  explicit Solver(GuardedRate& rate)
      : rate_(&rate),
        x_(Eigen::VectorXd::Zero(rate.size())),
        slope_(x_),
        context_(cvode::new_context()),
        vector_(cvode::fused(cvode::made(N_VNew_Serial(rate.size(), context_.get())))),
        absolute_(cvode::made(N_VNew_Serial(rate.size(), context_.get()))),
        inner_(cvode::fused(cvode::made(N_VNew_Serial(rate.size(), context_.get())))),
        memory_(cvode::made(CVodeCreate(CV_BDF, context_.get()))) {
    using cvode::require;
    require(CVodeSetErrFile(memory_.get(), nullptr));
    require(CVodeInit(memory_.get(), at, 0, vector_.get()));
    require(CVodeSetUserData(memory_.get(), this));
    require(CVodeSetMaxNumSteps(memory_.get(), kPatience));
    require(CVodeSetMaxHnilWarns(memory_.get(), -1));
    N_VConst(1, absolute_.get());
    require(CVodeSVtolerances(memory_.get(), 1e-8, absolute_.get()));
    const auto size = static_cast<sunindextype>(rate.size());
    matrix_.reset(cvode::made(SUNDenseMatrix(size, size, context_.get())));
    solver_.reset(cvode::made(SUNLinSol_Dense(vector_.get(), matrix_.get(), context_.get())));
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    // With a jacobian of 50 steps ago, as CVODE may use it, what decays fast is left wrong where
    // its rate has changed. So it costs less, too.
    require(CVodeSetNonlinConvCoef(memory_.get(), kSolved));
    require(CVodeSetLSetupFrequency(memory_.get(), jacobian_lasts));
    require(CVodeSetJacEvalFrequency(memory_.get(), jacobian_lasts));
  }

  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest) {
    t_ = t;
    last_ = last;
    relative_ = relative;
    longest_ = longest;
    flag_ = CV_SUCCESS;
    values(vector_) = x;
    values(absolute_) = absolute;
    begin();
  }

  bool step() {
    flag_ = one_step();
    if (fails_beside_the_flow()) {
      forgive_small_elements();
      begin();
      flag_ = one_step();
    }
    return flag_ >= 0;
  }

  double t() const { return t_; }
  bool has_escaped() const { return rate_->has_escaped(t_, values(vector_), slope_); }

  int degree() const {
    int order = 1;
    cvode::require(CVodeGetLastOrder(memory_.get(), &order));
    return order;
  }

  void within(double t, Eigen::VectorXd& x) const {
    cvode::require(CVodeGetDky(memory_.get(), t, 0, inner_.get()));
    x = values(inner_);
  }

 private:
  int one_step() {
    // Without a shortest step those of length 0 count as an arrival.
    cvode::require(
        CVodeSetMinStep(memory_.get(), std::numeric_limits<double>::epsilon() * std::abs(t_)));
    return CVode(memory_.get(), first_end_, vector_.get(), &t_, CV_ONE_STEP);
  }

  /// Whether other tolerances may go on: not where f has no value, nor where x escapes, since an
  /// implicit step leaps over a pole.
  bool fails_beside_the_flow() const {
    return (flag_ == CV_TOO_MUCH_WORK || flag_ == CV_ERR_FAILURE || flag_ == CV_CONV_FAILURE) &&
           rate_->trouble().empty() && !has_escaped();
  }

  /// An element that has died down in a stiff flow is noise of the iteration: then all count alike.
  void forgive_small_elements() {
    const double largest = values(vector_).lpNorm<Eigen::Infinity>();
    values(absolute_) = values(absolute_).cwiseMax(relative_ * largest);
  }

  void begin() {
    using cvode::require;
    require(CVodeReInit(memory_.get(), t_, vector_.get()));
    require(CVodeSVtolerances(memory_.get(), relative_, absolute_.get()));
    require(CVodeSetStopTime(memory_.get(), last_));
    // The shortest step of the flow before may be longer than the longest of this one.
    require(CVodeSetMinStep(memory_.get(), 0));
    require(CVodeSetMaxStep(memory_.get(), longest_));
    first_end_ = end_of_first();
  }

  /// The time within which CVODE seeks its first step: ten times what moves an element by its error
  /// or by a tenth. With all the time that is left rounding would make the first step too long.
  double end_of_first() {
    x_ = values(vector_);
    if (!rate_->at(t_, x_, slope_.data())) return last_;
    const double fastest =
        (slope_.array().abs() / (0.1 * x_.array().abs() + values(absolute_).array())).maxCoeff();
    constexpr double least = 1e3 * std::numeric_limits<double>::epsilon();
    return std::min(last_, t_ + std::max(10 / fastest, least * std::abs(t_)));
  }

  static Eigen::Map<Eigen::VectorXd> values(const cvode::Vector& vector) {
    return {NV_DATA_S(vector.get()), NV_LENGTH_S(vector.get())};
  }

  /// 0, or 1 where there is no value: CVODE tries a shorter step.
  static int at(double t, N_Vector x, N_Vector slope, void* self) {
    auto& solver = *static_cast<Solver*>(self);
    solver.x_ = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(x), solver.x_.size());
    if (!solver.rate_->at(t, solver.x_, NV_DATA_S(slope))) return 1;
    solver.slope_ = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(slope), solver.x_.size());
    return 0;
  }

  /// Steps after which the jacobian of the flow is made anew.
  static constexpr long jacobian_lasts = 5;

  GuardedRate* rate_;
  Eigen::VectorXd x_, slope_;  ///< where f was evaluated last, and its value
  int flag_ = 0;
  double t_ = 0, last_ = 0, relative_ = 0, longest_ = 0;
  double first_end_ = 0;  ///< up to where the first step may lead
  cvode::Owned<SUNContext, cvode::free_context> context_;
  cvode::Vector vector_, absolute_, inner_;
  cvode::Owned<SUNMatrix, SUNMatDestroy> matrix_;
  cvode::Owned<SUNLinearSolver, cvode::free_solver> solver_;
  std::unique_ptr<void, cvode::Freed<cvode::free_memory>> memory_;
};

ImplicitSteps::ImplicitSteps(GuardedRate& rate) : solver_(std::make_unique<Solver>(rate)) {}
ImplicitSteps::~ImplicitSteps() = default;

void ImplicitSteps::start(double t, const Eigen::VectorXd& x, double last, double relative,
                          const Eigen::VectorXd& absolute, double longest) {
  solver_->start(t, x, last, relative, absolute, longest);
}
bool ImplicitSteps::step() { return solver_->step(); }
double ImplicitSteps::t() const { return solver_->t(); }
bool ImplicitSteps::has_escaped() const { return solver_->has_escaped(); }
int ImplicitSteps::degree() const { return solver_->degree(); }
void ImplicitSteps::within(double t, Eigen::VectorXd& x) const { solver_->within(t, x); }

}  // namespace gainsmith::ode
