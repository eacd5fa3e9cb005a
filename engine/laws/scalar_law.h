// The laws of a contact on plain doubles: what is observed between steps, and what tests compare
// the kernels with.
#pragma once

#include "engine/laws/law_list.h"

namespace talus::engine {

using ScalarLaw = Response<double> (*)(const PairConstants&, const Contact<double>&, const double&,
                                       History<double>&);

template <class... Row>
ScalarLaw PickFromRow(int rolling, LawList<Row...>) {
  const ScalarLaw list[] = {&Respond<Row, double>...};
  return list[rolling];
}
template <class... Rows>
ScalarLaw PickFromRows(const ContactModels& models, LawList<Rows...>) {
  const ScalarLaw list[] = {PickFromRow(static_cast<int>(models.rolling), Rows{})...};
  return list[RowOf(models)];
}
inline ScalarLaw PickLaw(const ContactModels& models) { return PickFromRows(models, LawRows{}); }

}  // namespace talus::engine
