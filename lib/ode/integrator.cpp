#include "ode/integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

#include "base/number.h"
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
inline void free_iteration(SUNNonlinearSolver solver) { SUNNonlinSolFree(solver); }
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

class Solver {
 public:
  using Rate = Integrator::Rate;

  Solver(Eigen::Index size, Rate rate)
      : rate_(std::move(rate)),
        x_(Eigen::VectorXd::Zero(size)),
        slope_(Eigen::VectorXd::Zero(size)),
        context_(new_context()),
        vector_(fused(made(N_VNew_Serial(size, context_.get())))),
        absolute_(made(N_VNew_Serial(size, context_.get()))),
        inner_(fused(made(N_VNew_Serial(size, context_.get())))) {
    make(CV_ADAMS);
  }

  void reset() {
    if (method_ != CV_ADAMS) make(CV_ADAMS);
  }

  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest) {
    t_ = t;
    last_ = last;
    relative_ = relative;
    longest_ = longest;
    values(vector_) = x;
    // What the flow does in all its time is no escape.
    size_ = x.lpNorm<Eigen::Infinity>();
    if (rate(t, vector_.get(), absolute_.get()) == 0)
      size_ = std::max(size_, (last - t) * slope_.lpNorm<Eigen::Infinity>());
    values(absolute_) = absolute;
    begin();
  }

  void advance(double t, Eigen::VectorXd& x) {
    if (t > t_) {
      trouble_.clear();
      int flag = integrate(t);
      if (method_ == CV_ADAMS && is_stiff(flag)) {
        make(CV_BDF);
        begin();
        flag = integrate(t);
      }
      if (flag != CV_TOO_MUCH_WORK && is_stiff(flag)) {
        forgive_small_elements();
        begin();
        flag = integrate(t);
      }
      if (flag < 0) fail(flag);
    }
    x = values(vector_);
  }

  Integrator::Step step() {
    const double from = t_;
    trouble_.clear();
    if (method_ == CV_ADAMS && has_become_stiff()) become_stiff();
    int flag = one_step();
    if (method_ == CV_ADAMS && is_stiff(flag)) {
      become_stiff();
      flag = one_step();
    }
    if (is_stiff(flag)) {
      forgive_small_elements();
      begin();
      flag = one_step();
    }
    if (flag < 0) fail(flag);
    int order = 1;
    require(CVodeGetLastOrder(memory_.get(), &order));
    return {from, t_, order};
  }

  void within(double t, Eigen::VectorXd& x) {
    require(CVodeGetDky(memory_.get(), t, 0, inner_.get()));
    x = values(inner_);
  }

 private:
  [[noreturn]] void fail(int flag) const {
    const bool escaped = trouble_.empty() && has_escaped();
    throw IntegrationError(trouble(flag), t_, escaped, !trouble_.empty());
  }

  int one_step() {
    set_shortest_step(t_);
    return CVode(memory_.get(), first_end_, vector_.get(), &t_, CV_ONE_STEP);
  }

  /// Without it steps of length 0 count as an arrival.
  void set_shortest_step(double t) {
    require(CVodeSetMinStep(memory_.get(), std::numeric_limits<double>::epsilon() * std::abs(t)));
  }

  /// The time within which CVODE seeks its first step: ten times what moves an element by its error
  /// or by a tenth. With all the time that is left rounding would make the first step too long.
  double end_of_first() {
    if (rate(t_, vector_.get(), inner_.get()) != 0) return last_;
    const double fastest =
        (slope_.array().abs() / (0.1 * values(vector_).array().abs() + values(absolute_).array()))
            .maxCoeff();
    constexpr double least = 1e3 * std::numeric_limits<double>::epsilon();
    return std::min(last_, t_ + std::max(10 / fastest, least * std::abs(t_)));
  }

  void become_stiff() {
    make(CV_BDF);
    begin();
  }

  /// Steps that the iteration keeps short, and not the error.
  bool has_become_stiff() {
    if (++steps_ < window) return false;
    long failures = 0;
    require(CVodeGetNumNonlinSolvConvFails(memory_.get(), &failures));
    const bool stiff = failures - failures_ > kStiffFailures;
    steps_ = 0;
    failures_ = failures;
    return stiff;
  }

  int integrate(double t) {
    set_shortest_step(t);
    return CVode(memory_.get(), t, vector_.get(), &t_, CV_NORMAL);
  }

  /// Whether other steps may go on: not where f has no value, nor where x escapes, since an
  /// implicit step leaps over a pole.
  bool is_stiff(int flag) const {
    return (flag == CV_TOO_MUCH_WORK || flag == CV_ERR_FAILURE || flag == CV_CONV_FAILURE) &&
           trouble_.empty() && !has_escaped();
  }

  /// x has grown, and at its rate would go on to grow in the time that is left.
  bool has_escaped() const {
    const double now = values(vector_).lpNorm<Eigen::Infinity>();
    return size_ > 0 && now > kEscape * size_ &&
           (last_ - t_) * slope_.lpNorm<Eigen::Infinity>() > kEscape * now;
  }

  /// An element that has died down in a stiff flow is noise of the iteration: then all count alike.
  void forgive_small_elements() {
    const double largest = values(vector_).lpNorm<Eigen::Infinity>();
    values(absolute_) = values(absolute_).cwiseMax(relative_ * largest);
  }

  std::string trouble(int flag) const {
    if (trouble_.empty() && has_escaped()) return "the flow escapes";
    if (flag == CV_TOO_MUCH_WORK && trouble_.empty())
      return "the flow needs more than " + std::to_string(kPatience) + " steps";
    if (!trouble_.empty()) return trouble_;
    return "the steps of the integration fall to nothing (CVODE " + std::to_string(flag) + ")";
  }

  static Eigen::Map<Eigen::VectorXd> values(const Vector& vector) {
    return {NV_DATA_S(vector.get()), NV_LENGTH_S(vector.get())};
  }

  static int rate(double t, N_Vector x, N_Vector slope, void* self) {
    return static_cast<Solver*>(self)->rate(t, x, slope);
  }

  /// 0, or 1 where there is no value: CVODE tries a shorter step.
  int rate(double t, N_Vector x, N_Vector slope) {
    x_ = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(x), x_.size());
    try {
      rate_(std::min(t, last_), x_, slope_);
    } catch (const std::exception& error) {
      trouble_ = error.what();
      return 1;
    }
    if (!slope_.allFinite()) {
      trouble_ = "the flow is not finite";
      return 1;
    }
    Eigen::Map<Eigen::VectorXd>(NV_DATA_S(slope), slope_.size()) = slope_;
    return 0;
  }

  void make(int method) {
    method_ = method;
    memory_.reset(made(CVodeCreate(method, context_.get())));
    require(CVodeSetErrFile(memory_.get(), nullptr));
    require(CVodeInit(memory_.get(), rate, 0, vector_.get()));
    require(CVodeSetUserData(memory_.get(), this));
    require(CVodeSetMaxNumSteps(memory_.get(), kPatience));
    require(CVodeSetMaxHnilWarns(memory_.get(), -1));
    require(CVodeSVtolerances(memory_.get(), 1e-8, ones().get()));
    if (method == CV_ADAMS) {
      iteration_.reset(made(SUNNonlinSol_FixedPoint(vector_.get(), 0, context_.get())));
      require(CVodeSetNonlinearSolver(memory_.get(), iteration_.get()));
      return;
    }
    const auto size = static_cast<sunindextype>(x_.size());
    matrix_.reset(made(SUNDenseMatrix(size, size, context_.get())));
    solver_.reset(made(SUNLinSol_Dense(vector_.get(), matrix_.get(), context_.get())));
    require(CVodeSetLinearSolver(memory_.get(), solver_.get(), matrix_.get()));
    // With a jacobian of 50 steps ago, as CVODE may use it, what decays fast is left wrong where its
    // rate has changed. So it costs less, too.
    require(CVodeSetNonlinConvCoef(memory_.get(), kSolved));
    require(CVodeSetLSetupFrequency(memory_.get(), jacobian_lasts));
    require(CVodeSetJacEvalFrequency(memory_.get(), jacobian_lasts));
  }

  Vector ones() const {
    Vector vector(made(N_VClone(vector_.get())));
    N_VConst(1, vector.get());
    return vector;
  }

  void begin() {
    require(CVodeReInit(memory_.get(), t_, vector_.get()));
    require(CVodeSVtolerances(memory_.get(), relative_, absolute_.get()));
    require(CVodeSetStopTime(memory_.get(), last_));
    // The shortest step of the flow before may be longer than the longest of this one.
    require(CVodeSetMinStep(memory_.get(), 0));
    require(CVodeSetMaxStep(memory_.get(), longest_));
    steps_ = failures_ = 0;
    first_end_ = end_of_first();
  }

  /// Steps after which it is asked whether the flow is stiff.
  static constexpr long window = 1000;
  /// Steps after which the jacobian of the flow is made anew.
  static constexpr long jacobian_lasts = 5;

  Rate rate_;
  Eigen::VectorXd x_, slope_;
  std::string trouble_;  ///< why f had no value last
  int method_ = CV_ADAMS;
  double t_ = 0, last_ = 0, relative_ = 0, longest_ = 0;
  double first_end_ = 0;           ///< up to where the first step may lead
  double size_ = 0;                ///< of x at the start
  long steps_ = 0, failures_ = 0;  ///< of the iteration, in this window of steps and before it
  Owned<SUNContext, free_context> context_;
  Vector vector_, absolute_, inner_;
  Owned<SUNNonlinearSolver, free_iteration> iteration_;
  Owned<SUNMatrix, SUNMatDestroy> matrix_;
  Owned<SUNLinearSolver, free_solver> solver_;
  std::unique_ptr<void, Freed<free_memory>> memory_;
};

}  // namespace cvode

Integrator::Integrator(Eigen::Index size, Rate rate)
    : cvode_(size > 0 ? std::make_unique<cvode::Solver>(size, std::move(rate)) : nullptr) {}
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator& Integrator::operator=(Integrator&&) noexcept = default;
Integrator::~Integrator() = default;

void Integrator::reset() {
  if (cvode_) cvode_->reset();
}

void Integrator::start(double t, const Eigen::VectorXd& x, double last, double relative,
                       const Eigen::VectorXd& absolute, double longest) {
  last_ = last;
  t_ = t;
  if (cvode_) cvode_->start(t, x, last, relative, absolute, longest);
}

Integrator::Step Integrator::step() {
  if (cvode_) return cvode_->step();
  return {std::exchange(t_, last_), last_, 0};
}

void Integrator::within(double t, Eigen::VectorXd& x) {
  if (cvode_) cvode_->within(t, x);
}

void Integrator::advance(double t, Eigen::VectorXd& x) {
  if (cvode_) cvode_->advance(t, x);
}

}  // namespace gainsmith::ode
