#include "lmi/affine_maps.h"

#include <utility>

namespace gainsmith::lmi {

AffineForm sum(const AffineForm& a, const AffineForm& b, double factor) {
  AffineForm result = a;
  for (const auto& [key, matrix] : b.terms) add_term(result, key, matrix, factor);
  for (const Product& product : b.products) add_product(result.products, product, factor);
  return result;
}

AffineForm blocks(const expr::Instruction& instruction,
                  std::span<const AffineForm* const> operands) {
  AffineForm result{instruction.shape, {}};
  const auto columns = static_cast<std::size_t>(instruction.attributes[0]);
  int row = 0;
  for (std::size_t first = 0; first < operands.size(); first += columns) {
    int column = 0;
    for (std::size_t j = first; j < first + columns; ++j) {
      add_placed(result, *operands[j], row, column);
      column += operands[j]->shape.cols;
    }
    row += operands[first]->shape.rows;
  }
  return result;
}

AffineForm index(const expr::Instruction& instruction, const AffineForm& form) {
  const auto& [row, row_end, column, column_end] = instruction.attributes;
  const auto [rows, columns] = std::pair(instruction.shape.rows, instruction.shape.cols);
  AffineForm result{instruction.shape, {}};
  for (const auto& [key, matrix] : form.terms)
    add_term(result, key, Sparse(matrix.block(row, column, rows, columns)));
  for (Product product : form.products) {
    // Rows of E V F are those of E, columns those of F.
    product.left = Sparse(product.left.block(row, 0, rows, product.left.cols()));
    product.right = Sparse(product.right.block(0, column, product.right.rows(), columns));
    add_product(result.products, std::move(product));
  }
  return result;
}

AffineForm identity(const AffineForm& form, expr::Shape shape) {
  return map_terms(form, shape, [&](const Sparse& matrix) {
    Sparse eye(shape.rows, shape.cols);
    eye.setIdentity();
    return Sparse(matrix.coeff(0, 0) * eye);
  });
}

AffineForm trace(const AffineForm& form) {
  return map_terms(form, {}, [](const Sparse& matrix) {
    return sparse(numbers::Matrix::Constant(1, 1, matrix.diagonal().sum()));
  });
}

AffineForm diagonal(const expr::Instruction& instruction, const AffineForm& form) {
  const expr::Shape shape = instruction.shape;
  if (instruction.op == expr::Op::diagonal_of)
    return map_terms(form, shape, [](const Sparse& matrix) { return sparse(matrix.diagonal()); });
  return map_terms(form, shape, [&](const Sparse& matrix) {
    return moved(matrix, shape.rows, shape.cols, [](const auto& it, auto& elements) {
      const int at = static_cast<int>(it.row() + it.col());
      elements.emplace_back(at, at, it.value());
    });
  });
}

}  // namespace gainsmith::lmi
