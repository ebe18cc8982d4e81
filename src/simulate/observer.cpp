#include "subimpact/simulate/observer.h"

#include "system/accounts.h"

namespace subimpact {

PointMotion RunView::striker() const {
  return {Accounts(beam_).displacements(state_).striker, state_.back()};
}

PointMotion RunView::struck_point() const {
  return {Accounts(beam_).displacements(state_).struck,
          state_.back() - beam_.indentation_rate(state_)};
}

bool RunView::in_contact() const { return beam_.contact().is_closed(); }
double RunView::indentation() const { return beam_.indentation(state_); }
double RunView::residual_indentation() const { return beam_.contact().residual_indentation(); }
double RunView::contact_force() const { return beam_.contact_force(state_); }
Energies RunView::energies() const { return Accounts(beam_).energies(state_); }

}  // namespace subimpact
