"""Matrix files of Nastran: DMIG punch, OUTPUT4 (text and binary), HDF5."""

from fem.files.matrices.files import read_matrices as read_matrices
from fem.files.matrices.files import write_dmig as write_dmig
from fem.files.matrices.files import write_op4 as write_op4
from fem.output4.named import NamedMatrix as NamedMatrix
