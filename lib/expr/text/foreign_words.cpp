// A word of MATLAB, Python or Julia is answered by what to write here, never by another function:
// the same name may mean another thing there.
#include "expr/text/foreign_words.h"

#include <algorithm>
#include <array>
#include <utility>

#include "expr/binding/functions.h"

namespace gainsmith::expr {

namespace {

constexpr std::string_view kByGain =
    "there is none; state it as a design: 'gainsmith methods' lists those that are ready";
constexpr std::string_view kByUnknowns =
    "declare it under 'unknowns', such as 'P: symmetric n' or 'Y: n x p'";
constexpr std::string_view kInequality =
    "write each inequality under 'require', such as 'flow: He(P*A) < 0'";
constexpr std::string_view kSolve =
    "there is none; 'minimize' and 'require' state the program, 'gainsmith synth FILE' solves it";
constexpr std::string_view kNonlinear =
    "there is none; 'gainsmith optimize' searches over scalars outside of the inequalities";

/// A word, or several with spaces between them, and the advice.
using Row = std::pair<std::string_view, std::string_view>;
/// The first row that has the word counts.
constexpr auto kRows = std::to_array<Row>({
    {"transpose ctranspose adjoint T", "write A' for the transpose of A"},
    {"inverse matinv invert", "write inv(M)"},
    {"pseudoinverse moorepenrose", "write pinv(M)"},
    {"arctan", "write atan(x)"},
    {"arctan2 angle arg", "write atan2(y, x)"},
    {"arcsin", "write asin(x)"},
    {"arccos", "write acos(x)"},
    {"asinh arcsinh arsinh", "write log(x + sqrt(x.^2 + 1))"},
    {"acosh arccosh arcosh", "write log(x + sqrt(x.^2 - 1))"},
    {"atanh arctanh artanh", "write log((1 + x)./(1 - x))/2"},
    {"cot", "write 1./tan(x)"},
    {"sec", "write 1./cos(x)"},
    {"csc cosec", "write 1./sin(x)"},
    {"sinc", "there is none; write sin(x)./x where x is not 0"},
    {"ln loge", "write log(x), the natural logarithm"},
    {"log2 ld", "write log(x)/log(2)"},
    {"log1p", "write log(1 + x)"},
    {"expm1", "write exp(x) - 1"},
    {"cbrt", "write sign(x).*abs(x).^(1/3)"},
    {"nthroot", "write x.^(1/n)"},
    {"pow power", "write a^b, or a.^b for each element"},
    {"mpower matrix_power", "write M^k"},
    {"times multiply mul", "write A.*B for each element, A*B for the product"},
    {"rdivide divide", "write A./B for each element"},
    {"mtimes matmul", "write A*B"},
    {"mldivide solve linsolve", "write inv(A)*b"},
    {"dot inner vdot", "write x'*y"},
    {"outer", "write x*y'"},
    {"cross", "write skew(v)*w"},
    {"tr", "write trace(M)"},
    {"determinant", "write det(M)"},
    {"norm2 normest opnorm vecnorm", "write norm(M)"},
    {"norm1", "write sum(abs(v)) for a vector"},
    {"norminf normInf", "write max(abs(v)) for a vector"},
    {"frobenius norm_fro normf", "write sqrt(trace(M'*M))"},
    {"eigs eigvals eigenvalues eigenvalue spectrum poles pole",
     "write eig(M); of a symmetric M also lambda_max(M) and lambda_min(M)"},
    {"eigmax max_eig maxeig lambdamax max_eigenvalue",
     "write lambda_max(M) of a symmetric M, max(eig(M)(:, 1)) for the largest real part"},
    {"eigmin min_eig mineig lambdamin min_eigenvalue",
     "write lambda_min(M) of a symmetric M, min(eig(M)(:, 1)) for the smallest real part"},
    {"eigh", "write eig(M)"},
    {"spectral_radius specrad", "write max(sqrt(eig(M)(:, 1).^2 + eig(M)(:, 2).^2))"},
    {"svdvals singular_values", "write svd(M)"},
    {"sigma_max maxsvd", "write norm(M)"},
    {"sigma_min minsvd", "write min(svd(M))"},
    {"matrix_rank", "write rank(M)"},
    {"null_space nullspace kernel ker", "write null(M)"},
    {"range image colspace", "write orth(M)"},
    {"condition rcond", "write cond(M)"},
    {"logm", "there is no logarithm of a matrix; log(x) is element by element"},
    {"sqrtm", "there is no root of a matrix; sqrt(x) is element by element"},
    {"funm", "there is none; expm(M) is the matrix exponential"},
    {"cholesky", "write chol(M), the lower factor"},
    {"lu ldl qr schur hess",
     "there are no such factorisations; chol, orth, null, svd and complement "
     "give what is unique in them"},
    {"vec vectorize flatten ravel", "there is none; write [M(:, 1); M(:, 2); ...]"},
    {"reshape", "there is none; write a block of parts, such as [v(1:2), v(3:4)]"},
    {"hstack hcat", "write [A, B]"},
    {"vstack vcat", "write [A; B]"},
    {"cat concatenate", "write [A, B] or [A; B]"},
    {"block_diag blkdiagonal", "write blkdiag(A, B)"},
    {"repmat tile", "write kron(ones(n, m), M)"},
    {"identity speye Eye", "write eye(n), or I where the size is clear"},
    {"tril triu", "there is none; write the elements, or M.*[1, 0; 1, 1]"},
    {"toeplitz hankel", "there is none; write the rows"},
    {"size length numel rows columns",
     "sizes are names: n in the shape 'n x n' of a datum; the last index is 'end'"},
    {"linspace arange", "there is none; write the elements, such as [0, 0.5, 1]"},
    {"prod product", "there is none; write the factors, for positive ones exp(sum(log(v)))"},
    {"mean average", "write sum(v)/n"},
    {"cumsum diff", "there is none; write the sums or differences"},
    {"fix trunc", "write sign(x).*floor(abs(x))"},
    {"ceiling", "write ceil(x)"},
    {"rem fmod remainder", "write mod(a, b)"},
    {"fabs absolute", "write abs(x)"},
    {"sgn signum", "write sign(x)"},
    {"heaviside step", "write where(x > 0, 1, 0)"},
    {"saturate saturation clamp", "write clip(x, lo, hi), or sat(v, r) for a vector"},
    {"fmax", "write max(a, b)"},
    {"fmin", "write min(a, b)"},
    {"if ifelse select", "write where(a > b, x, y)"},
    {"piecewise", "write where(a > b, x, y), one in another for more than two"},
    {"interp interpolate lookup", "write interp1(x, y, q)"},
    {"spline pchip", "there is none; interp1(x, y, q) is linear between the points"},
    {"gradient grad", "write jacobian(e, x)"},
    {"hessian", "there are no second derivatives"},
    {"ctrbf controllability controllability_matrix reachability", "write ctrb(A, B)"},
    {"obsvf observability observability_matrix", "write obsv(A, C)"},
    {"gram", "write lyap(A, B*B') for the controllability Gramian, lyap(A', C'*C) for the other"},
    {"lyapunov continuous_lyapunov solve_continuous_lyapunov lyapc",
     "write lyap(A, Q), the X of A*X + X*A' + Q == 0"},
    {"discrete_lyapunov solve_discrete_lyapunov lyapd dlyapc",
     "write dlyap(A, Q), the X of A*X*A' - X + Q == 0"},
    {"sylvester sylv", "there is none; lyap(A, Q) solves A*X + X*A' + Q == 0"},
    {"icare are arec ric riccati solve_continuous_are carex", "write care(A, B, Q, R)"},
    {"idare ared solve_discrete_are darex", "write dare(A, B, Q, R)"},
    {"lqr", "write inv(R)*B'*care(A, B, Q, R)"},
    {"dlqr", "write inv(R + B'*X*B)*B'*X*A with X: dare(A, B, Q, R)"},
    {"lqe kalman", "write X*C'*inv(R) with X: care(A', C', Q, R)"},
    {"dlqe", "write X*C'*inv(R + C*X*C') with X: dare(A', C', Q, R)"},
    {"acker place_poles", "write place(A, B, p)"},
    {"conv", "write a product of transfer functions, tf(1, [5, 1])*tf(1, [1, 1])"},
    {"zpk", "write a product of transfer functions, or ss(A, B, C, D)"},
    {"pid pidstd", "write Kp + tf(Ki, [1, 0]) + tf([Kd, 0], [Tf, 1])"},
    {"delay delayss thiran padecoef", "write pade(T, n)"},
    {"sminreal minimal_realization", "write minreal(G)"},
    {"balreal modred balred", "there is none; minreal(G) leaves out hidden states"},
    {"bilinear", "write tustin(G, T)"},
    {"bode nyquist step impulse pzmap sigma margin",
     "ask for a picture under 'figures', which 'gainsmith plot' draws"},
    {"h2syn hinfsyn hinfnorm h2norm normhinf hinfstruct systune musyn hinfric ncfsyn", kByGain},
    {"sdpvar lmivar Variable symvar intvar binvar Semidef HermitianSemidef", kByUnknowns},
    {"semidefinite PSD isposdef", "write P > 0, or P >= 0 for positive semidefinite"},
    {"setlmis newlmi lmiterm getlmis lmiedit lmi set constraint", kInequality},
    {"feasp mincx solvesdp sdpsettings optimize optimise sedumi sdpt3 mosek scs Problem", kSolve},
    {"Minimize minimize Maximize maximize",
     "write 'minimize: ...', for the largest value 'minimize: -(...)'"},
    {"gevp", "write 'minimize: lambda_max(M, N)', the smallest l with M <= l*N"},
    {"quadprog linprog lsqlin coneprog qp", kSolve},
    {"fmincon fminsearch fminunc fminbnd lsqnonlin fsolve fzero patternsearch ga bmibnb",
     kNonlinear},
    {"dec2mat mat2dec decinfo matnbr", "the unknowns have their values in the gain file"},
    {"value double", "write the formula itself: gains and reports have the values of the unknowns"},
    {"quad_form", "write x'*P*x"},
    {"sum_squares sumsqr", "write v'*v"},
    {"sum_entries", "write sum(M)"},
    {"bmat block", "write [A, B; C, D]"},
    {"normNuc norm_nuc nuclear", "there is none; norm(M) is the largest singular value"},
    {"logdet log_det geomean",
     "there is none that a program of inequalities minimises; trace(M) is affine"},
    {"zoh cont2discrete discretize d2d",
     "write c2d(G, T) of a system, or c2d(A, B, T), which is [Ad, Bd]"},
    {"d2c", "there is none; a plant is given in continuous time, or as jumps"},
    {"ode45 odeint lsim initial",
     "there is none; state 'plant' with a 'flow', and "
     "'gainsmith simulate' runs it"},
    {"rand randn random", "there is none; what is drawn is under 'noise'"},
    {"real imag conj",
     "values are real; eig(M) has real parts in its first column, imaginary parts "
     "in its second"},
    {"isempty any all find", "there is none; conditions go into where(...)"},
});

}  // namespace

/// Of "np.linalg.inv" the last part counts.
std::string advice_on(std::string_view function) {
  if (const std::size_t dot = function.rfind('.'); dot != std::string_view::npos) {
    const std::string_view own = function.substr(dot + 1);
    if (find_function(own) != nullptr) return "write " + std::string(own) + "(...)";
    return advice_on(own);
  }
  for (const auto& [words, advice] : kRows)
    for (std::size_t begin = 0; begin < words.size();) {
      const std::size_t end = std::min(words.find(' ', begin), words.size());
      if (words.substr(begin, end - begin) == function) return std::string(advice);
      begin = end + 1;
    }
  return {};
}

}  // namespace gainsmith::expr
