// Linear systems as values: what is made of them has the transfer function that it should have.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>
#include <random>
#include <string>

#include "expr/world.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;
using Complex = std::complex<double>;
using Response = Eigen::MatrixXcd;

const Complex kPoints[] = {{0.3, 0.7}, {-0.2, 2.1}, {1.4, -0.6}};

class Systems : public testing::TestWithParam<int> {
 protected:
  Systems() : random(static_cast<unsigned>(GetParam())) {
    n = GetParam() % 4;
    add("G", n, 2, 3);
    add("H", 2, 3, 2);
    add("K", GetParam() % 3, 3, 2);
    add("L", 3, 2, 3);
    add("P", 2, 4, 5);
  }
  /// With m inputs and p outputs, as data and as a system.
  void add(const std::string& name, int states, int m, int p) {
    world.set(name + "a", random_matrix(random, states, states))
        .set(name + "b", random_matrix(random, states, m))
        .set(name + "c", random_matrix(random, p, states))
        .set(name + "d", 0.3 * random_matrix(random, p, m))
        .define(name, "ss(" + name + "a, " + name + "b, " + name + "c, " + name + "d)");
  }
  Response at(const std::string& text, Complex s) const {
    const std::string of = "(" + text + ")";
    const Matrix A = world(of + ".A"), B = world(of + ".B"), C = world(of + ".C"),
                 D = world(of + ".D");
    Response M = -A.cast<Complex>();
    M.diagonal().array() += s;
    Response value = D.cast<Complex>();
    if (A.size() > 0) value += C.cast<Complex>() * M.partialPivLu().solve(B.cast<Complex>());
    return value;
  }
  template <class Expected>
  void expect(const std::string& text, const Expected& expected) const {
    for (const Complex s : kPoints) {
      const Response found = at(text, s), wanted = expected(s);
      ASSERT_EQ(found.rows(), wanted.rows()) << text;
      ASSERT_EQ(found.cols(), wanted.cols()) << text;
      EXPECT_LT((found - wanted).norm(), 1e-10 * (1 + wanted.norm())) << text;
    }
  }
  static Response one(Eigen::Index size) { return Response::Identity(size, size); }

  std::mt19937 random;
  World world;
  int n = 0;
};

TEST_P(Systems, FollowEachOther) {
  expect("series(G, H)", [&](Complex s) { return Response(at("H", s) * at("G", s)); });
  expect("H*G", [&](Complex s) { return Response(at("H", s) * at("G", s)); });
  expect("series(G, H, L)",
         [&](Complex s) { return Response(at("L", s) * at("H", s) * at("G", s)); });
  expect("2*G", [&](Complex s) { return Response(2.0 * at("G", s)); });
  expect("G/4", [&](Complex s) { return Response(0.25 * at("G", s)); });
  expect("-G", [&](Complex s) { return Response(-at("G", s)); });
  expect("Hd*G", [&](Complex s) { return Response(world("Hd").cast<Complex>() * at("G", s)); });
}

TEST_P(Systems, AddUp) {
  expect("G + L", [&](Complex s) { return Response(at("G", s) + at("L", s)); });
  expect("G - Gd", [&](Complex s) { return Response(at("G", s) - world("Gd").cast<Complex>()); });
  expect("I - H*G", [&](Complex s) { return Response(one(2) - at("H", s) * at("G", s)); });
  expect("append(G, 3)", [&](Complex s) {
    Response whole = Response::Zero(4, 3);
    whole.topLeftCorner(3, 2) = at("G", s);
    whole(3, 2) = 3;
    return whole;
  });
}

TEST_P(Systems, CloseLoops) {
  expect("feedback(G, K)", [&](Complex s) {
    const Response G = at("G", s);
    return Response((one(3) + G * at("K", s)).inverse() * G);
  });
  expect("feedback(H*G)", [&](Complex s) {
    const Response L = at("H*G", s);
    return Response((one(2) + L).inverse() * L);
  });
  expect("feedback(1, H*G)",
         [&](Complex s) { return Response((one(2) + at("H*G", s)).inverse()); });
  // P has 4 inputs and 5 outputs, K 3 inputs and 2 outputs.
  expect("lft(P, K)", [&](Complex s) {
    const Response P = at("P", s), K = at("K", s);
    const Response loop = (one(2) - K * P.bottomRightCorner(3, 2)).inverse() * K;
    return Response(P.topLeftCorner(2, 2) +
                    P.topRightCorner(2, 2) * loop * P.bottomLeftCorner(3, 2));
  });
}

TEST_P(Systems, AreWeighted) {
  expect("augw(G, tf(1, [1, 2]), 5, tf([1, 0], [1, 3]))", [&](Complex s) {
    const Response G = at("G", s);
    Response P = Response::Zero(11, 5);
    const Complex w1 = 1.0 / (s + 2.0), w3 = s / (s + 3.0);
    P.topLeftCorner(3, 3) = w1 * one(3);
    P.block(0, 3, 3, 2) = -w1 * G;
    P.block(3, 3, 2, 2) = 5.0 * one(2);
    P.block(5, 3, 3, 2) = w3 * G;
    P.bottomLeftCorner(3, 3) = one(3);
    P.bottomRightCorner(3, 2) = -G;
    return P;
  });
  expect("augw(H, L)", [&](Complex s) {
    Response P(5, 5);
    P << at("L", s), -at("L", s) * at("H", s), one(2), -at("H", s);
    return P;
  });
}

/// Hidden states are left out, whatever the coordinates.
TEST_P(Systems, HaveMinimalRealizations) {
  world.define("P0", "append(L, K)")
      .define("U",
              "orth([1, 2, 0, 0, 1; 0, 1, 3, 0, 2; 1, 0, 1, 1, 0; 0, "
              "0, 1, 4, 1; 2, 1, 0, 0, 5])");
  const auto states = [&](const std::string& text) { return world("(" + text + ").A").rows(); };
  const auto expect_least = [&](const std::string& text, Eigen::Index least) {
    EXPECT_EQ(states("minreal(" + text + ")"), least) << text;
    expect("minreal(" + text + ")", [&](Complex s) { return at(text, s); });
  };
  expect_least("G", n);
  expect_least("H*G", n + 2);
  // Twice the same, one of which inputs do not reach; one that is not seen.
  expect_least("G + G", n);
  expect_least("L - L", 0);
  expect_least("ss([La, zeros(3, 2); zeros(2, 3), Ha], [Lb; zeros(2, 2)], [Lc, ones(3, 2)], Ld)",
               3);
  // Of numbers far apart nothing is hidden.
  for (const auto& [text, least] : {std::pair("tf(1, [1e-9, 1e-3, 1])", 2),
                                    {"tf(1.6e9, [1, 800, 240000, 3.2e7, 1.6e9])", 4},
                                    {"tf(1, [1, 1000, 1e5, 1e7, 1e8, 1e9])", 5},
                                    {"tf(1, [1e-7, 1])*tf(1, [100, 1])", 2},
                                    {"tf(1e10, [1, 1])*tf(1e-10, [1, 2])", 2},
                                    {"tf(1e12, [1, 1e3, 1e8, 1e12])", 3},
                                    {"ss([-1, 0; 0, -2], [1; 1e-10], [1, 1e10], 0)", 2},
                                    {"tf([1, 1], [1, 0])*tf(1, [1, 1])", 1},
                                    {"tf([1, 1], [1, 0, 0])*tf(1, [1, 1])", 2},
                                    {"tf(1, [1, 0]) + tf(1, [1, 0])", 1},
                                    {"tf(1, [1, 0]) - tf(1, [1, 0])", 0}})
    EXPECT_EQ(states(std::string("minreal(") + text + ")"), least) << text;
  expect_least(
      "ss(U'*[La, zeros(3, 2); ones(2, 3), Ha]*U, U'*[Lb; Hb(:, 1), Hb(:, 2)], [Lc, zeros(3, "
      "2)]*U, Ld)",
      3);
}

TEST_P(Systems, AreSampled) {
  const double T = 0.3;
  for (const std::string of : {"G", "L"}) {
    // The bilinear map, and at z = exp(s T) of a held input the matrices of the pair.
    for (const Complex z : kPoints) {
      const Response found = at("tustin(" + of + ", 0.3)", z);
      const Response wanted = at(of, 2 / T * (z - 1.0) / (z + 1.0));
      EXPECT_LT((found - wanted).norm(), 1e-10 * (1 + wanted.norm())) << of;
    }
    if (world(of + ".A").size() == 0) continue;
    const Matrix both = world("c2d(" + of + ".A, " + of + ".B, 0.3)"),
                 A = world("c2d(" + of + ", 0.3).A"), B = world("c2d(" + of + ", 0.3).B");
    EXPECT_LT((both.leftCols(A.cols()) - A).norm() + (both.rightCols(B.cols()) - B).norm(), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Systems, testing::Range(0, 12));

/// The characteristic polynomial of A - B K is that of the poles.
class Placement : public testing::TestWithParam<int> {};

TEST_P(Placement, MovesPoles) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const int n = 1 + GetParam() % 8, m = 1 + GetParam() % 3;
  const int pairs = GetParam() % (n / 2 + 1);
  World world;
  world.set("A", random_matrix(random, n, n)).set("B", random_matrix(random, n, m));
  // From the fifth case on one pole, or pair, is there several times.
  std::vector<Complex> poles;
  std::string real, imaginary;
  const auto add = [&](double x, double y) {
    poles.emplace_back(x, y);
    real += (real.empty() ? "" : ", ") + std::to_string(x);
    imaginary += (imaginary.empty() ? "" : ", ") + std::to_string(y);
  };
  const bool repeated = GetParam() >= 24;
  for (int k = 0; k < pairs; ++k) {
    add(-1 - (repeated ? 0 : 0.4 * k), 2.5);
    add(-1 - (repeated ? 0 : 0.4 * k), -2.5);
  }
  for (int k = 2 * pairs; k < n; ++k) add(repeated ? -1.5 : -2 - 0.5 * k, 0);
  const std::string p = pairs == 0 ? "[" + real + "]" : "[" + real + "; " + imaginary + "]";
  const Matrix closed = world("A - B*place(A, B, " + p + ")");
  for (const Complex s : kPoints) {
    Response M = -closed.cast<Complex>();
    M.diagonal().array() += s;
    Complex wanted = 1;
    for (const Complex pole : poles) wanted *= s - pole;
    EXPECT_LT(std::abs(M.determinant() - wanted),
              (repeated && m == 1 ? 1e-5 : 1e-7) * (1 + std::abs(wanted)))
        << p;
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Placement, testing::Range(0, 40));

class TransferFunctions : public testing::Test {
 protected:
  Complex at(const std::string& text, Complex s) const {
    const std::string of = "(" + text + ")";
    const Matrix A = world(of + ".A"), B = world(of + ".B"), C = world(of + ".C"),
                 D = world(of + ".D");
    Response M = -A.cast<Complex>();
    M.diagonal().array() += s;
    Response value = D.cast<Complex>();
    if (A.size() > 0) value += C.cast<Complex>() * M.partialPivLu().solve(B.cast<Complex>());
    return value(0, 0);
  }
  void expect(const std::string& text, Complex (*expected)(Complex)) const {
    for (const Complex s : kPoints)
      EXPECT_LT(std::abs(at(text, s) - expected(s)), 1e-12 * (1 + std::abs(expected(s)))) << text;
  }
  World world;
};

TEST_F(TransferFunctions, HaveTheirPolynomials) {
  expect("tf(3, 4)", [](Complex) { return Complex(0.75); });
  expect("tf([2, 5], [1, 3])", [](Complex s) { return (2.0 * s + 5.0) / (s + 3.0); });
  expect("tf(7, [2, 0, 1])", [](Complex s) { return 7.0 / (2.0 * s * s + 1.0); });
  expect("tf([1, 2, 3], [4, 5, 6])",
         [](Complex s) { return (s * s + 2.0 * s + 3.0) / (4.0 * s * s + 5.0 * s + 6.0); });
  expect("tf([1; 2], [1; 0; 0; 9])", [](Complex s) { return (s + 2.0) / (s * s * s + 9.0); });
}

TEST_F(TransferFunctions, ApproximateDelays) {
  expect("pade(0.5, 0)", [](Complex) { return Complex(1); });
  expect("pade(0.5, 1)", [](Complex s) { return (1.0 - 0.25 * s) / (1.0 + 0.25 * s); });
  expect("pade(2, 2)", [](Complex s) { return (1.0 - s + s * s / 3.0) / (1.0 + s + s * s / 3.0); });
  for (const Complex s : kPoints)
    EXPECT_LT(std::abs(at("pade(0.5, 5)", s) - std::exp(-0.5 * s)), 1e-9);
  EXPECT_LT(std::abs(at("pade(1e-3, 10)", Complex(0, 2000)) - std::exp(Complex(0, -2))), 1e-9);
}

TEST_F(TransferFunctions, KeepTheirSamplingTime) {
  world.define("G", "tf(1, [1, 0.5], 0.1)").define("F", "tf(1, [1, 1])");
  EXPECT_EQ(world("(G*G).A").rows(), 2);
  EXPECT_EQ(world("(2*G).A").rows(), 1);
  EXPECT_NE(input_error([&] { world("(G*F).A"); }).message().find("c2d(A, B, T)"),
            std::string::npos);
  EXPECT_NE(input_error([&] { world("(G + tf(1, [1, 0], 0.2)).A"); })
                .message()
                .find("different sampling"),
            std::string::npos);
}

TEST_F(TransferFunctions, AreNoMatrices) {
  world.define("G", "tf(1, [1, 2])").set("M", Matrix::Identity(2, 2));
  const auto says = [&](const std::string& text, const std::string& what) {
    const std::string message = input_error([&] { world(text); }).message();
    EXPECT_NE(message.find(what), std::string::npos) << text << ": " << message;
  };
  says("G", "G.A, .B, .C and .D");
  says("[G, 1]", "'G' is a system");
  says("inv(G)", "'G' is a system");
  says("G'", "'G' is a system");
  says("G(1, 1)", "is a system");
  says("M.A", "unknown name 'M.A'");
  says("G.E", "unknown name 'G.E'");
  says("G*M", "do not fit: 2 outputs meet inputs: 1");
  says("tf([1, 2, 3], [1, 2])", "no longer than den");
  says("tf(M, 1)", "coefficients of a polynomial");
  says("pade(1, 0.5)", "whole number");
  says("lft(G, M)", "lft(P, K) needs P");
  says("c2d(tf(1, [1, 0], 0.1), 0.2)", "sampled already");
  says("place(M, [1; 1], [-1, -2, -3])", "place needs 2 poles");
  says("place([0, 1; 0, 0], [0; 1], [-1, -1; 2, 3])", "with its conjugate");
  says("place(M, [1; 0], [-1, -2])", "place: ");
  says("G/(1 + G)", "systems are not divided");
  says("1/(1 + G)", "a closed loop is feedback(G, K)");
  says("feedback(G, M)", "needs K with 1 inputs and 1 outputs");
  says("ss(M, M, M)", "'ss' is written");
}

}  // namespace
}  // namespace gainsmith::expr
