"""Matrix files of Nastran: DMIG punch, OUTPUT4 (text and binary), HDF5."""

from drake_landing.matrices.files import read_matrices as read_matrices
from drake_landing.matrices.files import write_dmig as write_dmig
from drake_landing.matrices.files import write_op4 as write_op4
from drake_landing.matrices.named import NamedMatrix as NamedMatrix
