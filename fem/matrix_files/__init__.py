"""Files of matrices by name that need no deck: OUTPUT4, the HDF5 of MSC."""
