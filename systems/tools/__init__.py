"""Vectors, tables, checks and compilation: the vocabulary of the laws."""
