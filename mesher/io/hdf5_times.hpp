#pragma once
/// Time stamps in HDF5 files.

#include <string>

namespace quadrille {

/// Sets the times of groups and data sets in an HDF5 file (last access, change, birth) to 0, so that equal
/// contents give equal bytes: libmed offers no way to make objects without times. Only object headers of
/// version 2, which libmed writes, are changed. Linear in the file's length. Based on: HDF5 File Format
/// Specification 3.0, IV.A.1.b.
void clear_times(std::string& file);

}  // namespace quadrille
