#pragma once

namespace subimpact {

/// Start and end (us) of the first nine sub-impacts of the paper's example with exact sections in
/// the limit of fine meshes: extrapolated from 4003 and 8007 cells of this program.
inline constexpr double yielding_limit_us[9][2] = {
    {0.000, 201.471},   {203.299, 216.261}, {222.386, 275.651},
    {290.740, 314.837}, {347.832, 371.940}, {428.736, 460.403},
    {552.670, 567.946}, {572.759, 588.389}, {785.357, 796.643}};

}  // namespace subimpact
