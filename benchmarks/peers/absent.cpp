// Peers that this build has no library for.

#include "peer.h"

namespace subimpact::peers {

#ifndef SUBIMPACT_HAS_ODEINT
std::vector<Peer> odeint_peers() { return {}; }
#endif
#ifndef SUBIMPACT_HAS_GSL
std::vector<Peer> gsl_peers() { return {}; }
#endif
#ifndef SUBIMPACT_HAS_PETSC
std::vector<Peer> petsc_peers() { return {}; }
#endif

}  // namespace subimpact::peers
