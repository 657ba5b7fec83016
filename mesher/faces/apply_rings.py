import shutil
for f,d in (('hole_rings','faces'),('ring_quads','quads')):
    for e in ('hpp','cpp'): shutil.copy(f'new/{f}.{e}',f'mesher/{d}/{f}.{e}')
p='mesher/shell/face_mesher.cpp'; s=open(p).read()
def rep(a,b):
    global s
    if a not in s: raise SystemExit('missing '+a)
    s=s.replace(a,b,1)
rep('#include "mesher/faces/point_placement.hpp"\n','#include "mesher/faces/hole_rings.hpp"\n#include "mesher/faces/point_placement.hpp"\n')
rep('#include "mesher/quads/improve.hpp"\n','#include "mesher/quads/improve.hpp"\n#include "mesher/quads/ring_quads.hpp"\n')

rep("""  bool clean_up;
  const char* note;
""","""  bool clean_up;
  int rings;  ///< round each hole without corners
  const char* note;
""")
rep('true}, true, ""}','true}, true, 1, ""}')
s=s.replace('true}, false, "without','true}, false, 0, "without').replace('true}, true, "','true}, true, 0, "').replace('false}, true, "hex','false}, true, 0, "hex')
rep("""    FaceTriangulation triangulation = triangulate(attempt);
    FaceQuads quads = recombine_face(triangulation);
    improve(quads, attempt.clean_up);
""","""    const HoleRings rings = place_rings(boundary_, surface_, domain_, attempt.rings);
    FaceTriangulation triangulation = triangulate(attempt, rings);
    FaceQuads quads = recombine_face(triangulation);
    improve(quads, attempt.clean_up);
    if (rings.any) {
      add_ring_quads(quads, triangulation.segments, rings, boundary_, surface_);
      if (boundary_.stride == 1) improve(quads, false);
    }
""")
rep("""  FaceTriangulation triangulate(const Attempt& attempt) {
    const StageTimer timer(context_, "triangulate");
    const PlacedPoints placed =
        place_points(boundary_, surface_, domain_, size_at_, attempt.placement, context_);
    context_.check();
    return triangulate_face(face_ + 1, boundary_, placed, surface_, context_);
""","""  FaceTriangulation triangulate(const Attempt& attempt, const HoleRings& rings) {
    const StageTimer timer(context_, "triangulate");
    const TrimmedDomain domain = rings.any ? enclosed_domain(rings.inside) : domain_;
    const PlacedPoints placed =
        place_points(rings.inside, surface_, domain, size_at_, attempt.placement, context_);
    context_.check();
    return triangulate_face(face_ + 1, rings.inside, placed, surface_, context_);
""")
open(p,'w').write(s)
