#pragma once
/// Time stamps in HDF5 files.

#include <string>

namespace quadrille {

/// Sets the times that an HDF5 file keeps of its groups and data sets (last access, change, birth) to 0, so
/// that equal contents give equal bytes: libmed offers no way to make objects without them. Object headers of
/// other kinds than version 2, which libmed writes, stay as they are. Linear in the file's length. Based on:
/// HDF5 File Format Specification 3.0, IV.A.1.b.
void clear_times(std::string& file);

}  // namespace quadrille
