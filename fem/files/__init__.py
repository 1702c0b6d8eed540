"""Files of results and matrices: HDF5, OP2, ParaView, OUTPUT4, DMIG."""
