#include "support/sdp_build.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gainsmith::sdp::testing {

void put(std::vector<Entry>& list, int block, const MatrixXd& matrix, int first) {
  for (int j = 0; j < matrix.cols(); ++j)
    for (int i = 0; i <= j; ++i)
      if (matrix(i, j) != 0) list.push_back({block, first + i, first + j, matrix(i, j)});
}

Problem empty(std::vector<Block> blocks, int m) {
  Problem problem;
  problem.blocks = std::move(blocks);
  problem.c.assign(static_cast<std::size_t>(m), 0.0);
  problem.f.resize(static_cast<std::size_t>(m) + 1);
  return problem;
}

namespace {

/// F_i in block b, i from 1.
MatrixXd coefficient_block(const Planted& plan, int i, int b, Random& random) {
  const Block& block = plan.blocks[at(b)];
  MatrixXd f = random.symmetric(block.size);
  if (i == 1) f = f * f + MatrixXd::Identity(block.size, block.size);
  if (block.diagonal) f = MatrixXd(f.diagonal().asDiagonal());
  if (i == 1) return f;
  if (plan.skip > 0 && (i + b) % plan.skip == 0) f.setZero();
  if (plan.rows == 0 || block.diagonal) return f;
  const int first = i % (block.size - plan.rows + 1);
  const auto is_zero = [&](int row) { return row < first || row >= first + plan.rows; };
  for (int q = 0; q < block.size; ++q)
    for (int p = 0; p < block.size; ++p)
      if (is_zero(p) && is_zero(q)) f(p, q) = 0;
  return f;
}

using BlockList = std::vector<MatrixXd>;

/// F_i, i from 1, of which F_i.D = 0 for i > 1: a multiple of D is taken off where F_i has entries.
BlockList coefficient(const Planted& plan, int i, const BlockList& d, Random& random) {
  const double scale = std::pow(10.0, plan.spread * random.number());
  BlockList f, part;
  double f_d = 0, d_d = 0;
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    f.push_back(scale * coefficient_block(plan, i, static_cast<int>(b), random));
    if (i == 1) continue;
    part.push_back((f[b].array() != 0).select(d[b], MatrixXd::Zero(f[b].rows(), f[b].cols())));
    f_d += trace_product(f[b], part[b]);
    d_d += trace_product(part[b], part[b]);
  }
  for (std::size_t b = 0; b < part.size(); ++b) f[b] -= f_d / d_d * part[b];
  return f;
}

}  // namespace

CatalogueProblem planted(const Planted& plan) {
  Random random(plan.seed);
  BlockList X, Y, f0, d;
  for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
    const int n = plan.blocks[b].size, rank = plan.rank[b], gap = b == 0 ? plan.gap : 0;
    const MatrixXd q =
        plan.blocks[b].diagonal ? MatrixXd(MatrixXd::Identity(n, n)) : random.orthogonal(n);
    VectorXd lambda = VectorXd::Zero(n), omega = VectorXd::Zero(n);
    for (int i = 0; i < rank; ++i) lambda[i] = 1.5 + random.number();
    for (int i = rank + gap; i < n; ++i) omega[i] = 1.5 + random.number();
    X.push_back(q * lambda.asDiagonal() * q.transpose());
    Y.push_back(q * omega.asDiagonal() * q.transpose());
    f0.push_back(-X.back());
  }
  CatalogueProblem result{plan.name, empty(plan.blocks, plan.m)};
  for (int i = 1; i <= plan.m; ++i) {
    const BlockList f = coefficient(plan, i, d, random);
    double norm = 0, f_y = 0, trace = 0;
    for (std::size_t b = 0; b < f.size(); ++b) {
      norm = std::hypot(norm, f[b].norm());
      f_y += trace_product(f[b], Y[b]);
      trace += f[b].trace();
    }
    if (i == 1)
      for (const MatrixXd& y : Y)
        d.push_back(y - f_y / trace * MatrixXd::Identity(y.rows(), y.cols()));
    const double x = random.number() / norm;
    for (std::size_t b = 0; b < f.size(); ++b) {
      f0[b] += x * f[b];
      put(result.problem.f[at(i)], static_cast<int>(b), f[b]);
    }
    result.problem.c[at(i) - 1] = f_y;
    result.optimum += f_y * x;
  }
  for (std::size_t b = 0; b < f0.size(); ++b)
    put(result.problem.f[0], static_cast<int>(b), 0.5 * (f0[b] + f0[b].transpose()));
  return result;
}

CatalogueProblem direct_sum(const std::string& name, const std::vector<CatalogueProblem>& parts) {
  CatalogueProblem result{name, empty({}, 0)};
  Problem& sum = result.problem;
  for (const CatalogueProblem& part : parts) {
    const int offset = static_cast<int>(sum.blocks.size());
    const auto append = [&](const std::vector<Entry>& from, std::vector<Entry>& to) {
      for (Entry e : from) {
        e.block += offset;
        to.push_back(e);
      }
    };
    sum.blocks.insert(sum.blocks.end(), part.problem.blocks.begin(), part.problem.blocks.end());
    append(part.problem.f[0], sum.f[0]);
    for (std::size_t i = 0; i < part.problem.c.size(); ++i) {
      sum.c.push_back(part.problem.c[i]);
      append(part.problem.f[i + 1], sum.f.emplace_back());
    }
    if (part.answer != Answer::optimum) result.answer = part.answer;
    result.optimum += part.optimum;
    result.digits = std::min(result.digits, part.digits);
  }
  return result;
}

}  // namespace gainsmith::sdp::testing
