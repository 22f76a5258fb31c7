// Stands in for the peers that this build lacks.

#include "bench/peers/peers.h"

namespace glovebench::bench {

#ifndef GLOVEBENCH_HAS_FAISS
const MakeLookUpPeer kFaiss = nullptr, kFaissBytes = nullptr, kFaiss8Bit = nullptr, kFaissPq = nullptr,
                     kFaissHnsw = nullptr;
#endif
#ifndef GLOVEBENCH_HAS_EMBREE
const MakeClosestPointPeer kEmbree = nullptr;
#endif
#ifndef GLOVEBENCH_HAS_CGAL
const MakeClosestPointPeer kCgal = nullptr;
#endif
#ifndef GLOVEBENCH_HAS_PCL
const AlignPeer kPcl = nullptr;
#endif

}  // namespace glovebench::bench
