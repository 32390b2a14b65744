// The product A = J W J^T + compliance of implicit constraints, entry by entry. Two rows that share a vertex
// k with the weight w_k have the entry s_r s_s w_k (n_r . n_s); weights and signs never change, so what is
// left of the sparse product is one dot product an entry, in an order that is fixed.
//
// Based on: Va, Choi, Hong. Real-time Cloth Simulation Using Compute Shader (docs/methods/
//   implicit_constraints.md): J M^-1 J^T as a sparse product on the device, then conjugate gradients.
// Departures: the pattern and the weights are made once, on the host, by topology.
// Bytes per entry (float): 44 read, 4 written.
#include "shared/portable.glsl"

PARAMS
{
    uint count; // entries
};

READ(0, uint, pair);   // two an entry: its row and its column
READ(1, real, weight); // 1/kg; sum of s_r s_s w_k over the vertices that the two rows share
READ(2, rvec4, direction);
WRITE(3, real, values);

KERNEL(count)
{
    uint r = pair[2u * i];
    uint c = pair[2u * i + 1u];
    rvec4 n = direction[r];
    PRECISE real value = weight[i] * dot(rvec3(n), rvec3(direction[c]));
    PRECISE real diagonal = value + n.w;
    values[i] = r == c ? diagonal : value;
}
