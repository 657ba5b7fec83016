#pragma once
/// Sizes and divisions as users write them: "box:0,0,0,10,10,5=0.5", "Edge4=20". Internal.

#include <string>
#include <vector>

#include "geometry/sizing/sizing_options.hpp"

namespace quadrille {

/// Entries of settings whose lists have a form of their own. Each set function throws std::invalid_argument
/// with a text to append to the setting's name: "takes ..., not '...'".
using Entries = std::vector<std::string>;

/// "box:x,y,z,x,y,z=SIZE", "sphere:x,y,z,r=SIZE", "cylinder:x,y,z,x,y,z,r=SIZE",
/// "halfspace:x,y,z,nx,ny,nz=SIZE", each with an optional ",TRANSITION" after SIZE.
void set_regions(SizingOptions& sizing, const Entries& entries);
Entries regions_of(const SizingOptions& sizing);

/// "Edge7", "Face3"; one entry may hold several, separated by commas.
void set_kept(SizingOptions& sizing, const Entries& entries);
Entries kept_of(const SizingOptions& sizing);

/// "Edge4=20" for segments, "Edge4=1.2" for a bias; one entry may hold several, separated by commas.
/// \tparam place the member of EdgeSpacing
template <auto place>
void set_spacings(SizingOptions& sizing, const Entries& entries);
template <auto place>
Entries spacings_of(const SizingOptions& sizing);

/// "x,y,z" or "Name=x,y,z". Names are letters, digits, '_' and '-', and none is a group's name already.
void set_nodes(SizingOptions& sizing, const Entries& entries);
Entries nodes_of(const SizingOptions& sizing);

/// "0.05" (mm) or "2%" (of the size).
void set_chord_error(SizingOptions& sizing, const std::string& text);
std::string chord_error_of(const SizingOptions& sizing);

}  // namespace quadrille
