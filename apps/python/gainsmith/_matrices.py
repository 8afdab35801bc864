"""Matrices: arrays of NumPy where it is installed, otherwise lists of rows."""
try:
    import numpy
except ImportError:
    numpy = None


def matrix(value):
    """What the program writes of a matrix, as rows x columns: a number is 1 x 1, null is None."""
    if value is None:
        return None
    rows = value if isinstance(value, list) else [[value]]
    if numpy is None:
        return [[_number(element) for element in row] for row in rows]
    return numpy.array(rows, dtype=float).reshape(len(rows), -1 if rows else 0)


def block(value):
    """A block of a semidefinite program: a matrix, or the diagonal (n,) of a diagonal one."""
    return matrix(value) if value and isinstance(value[0], list) else column(value)


def matrices(values):
    """The same of a mapping of names."""
    return {name: matrix(value) for name, value in values.items()}


def column(values):
    """A column of a table: floats, with nan for null; a list where there are texts."""
    if any(isinstance(value, str) for value in values):
        return list(values)
    numbers = [_number(value) for value in values]
    return numbers if numpy is None else numpy.array(numbers)


def beside(columns):
    """Columns of one length side by side: (rows, columns)."""
    return [list(row) for row in zip(*columns)] if numpy is None else numpy.column_stack(columns)


def polynomial(coefficients, value):
    """coefficients[0] + coefficients[1]*value + ... of matrices, by Horner's scheme."""
    total = coefficients[-1]
    for each in reversed(coefficients[:-1]):
        if numpy is None:
            total = [[a * value + b for a, b in zip(*rows)] for rows in zip(total, each)]
        else:
            total = total * value + each
    return total


def _number(value):
    return float("nan") if value is None else float(value)
