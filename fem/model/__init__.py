"""A deck and one of its subcases, put together: matrices, weight, mechanisms."""
