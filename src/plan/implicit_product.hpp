#pragma once
// Internal to src/plan: the matrix of a Newton step as an operator that stores nothing.

#include "taut/linear/operator.hpp"

#include <string>
#include <vector>

namespace taut {

/// Elements of one kind, formed again by kernels/methods/implicit_euler/.
struct ImplicitKindBuffers
{
    std::string kernel; ///< "implicit_euler_product_hinge"
    BufferPtr records, table;
};

/// Buffers on paper; without tetrahedra theirs are null.
struct ImplicitBuffers
{
    std::uint32_t vertices = 0;
    Precision precision = Precision::float32;
    float scale = 1; ///< the system is in these units of mass
    BufferPtr position, delta, step_values;
    BufferPtr springs, spring_table; ///< always; a table without entries for the mass alone
    std::vector<ImplicitKindBuffers> kinds;
    BufferPtr solids, solid_state, solid_table; ///< null: none
};

/// (M + h^2 K + h D) x by gathering, with springs and other elements formed again from the places of their
/// corners, and tetrahedra from what implicit_solids left.
class ImplicitProduct final : public linear::Operator
{
public:
    explicit ImplicitProduct(ImplicitBuffers buffers) : at_(std::move(buffers)) {}

    std::uint32_t rows() const override { return 3 * at_.vertices; }
    Precision precision() const override { return at_.precision; }
    std::uint64_t bytes() const override { return 0; }
    void record_product(Recorder&, const linear::Gate&, Binding x, Binding y,
                        Binding partials) const override;
    void record_residual(Recorder&, const linear::Gate&, Binding x, Binding b, Binding r) const override;

private:
    struct Pass
    {
        std::string_view variant;
        Binding x, y, partials, b; ///< the last two where the variant has them
    };
    void record_springs(Recorder&, const linear::Gate&, const Pass&) const;
    void record_kind(Recorder&, const linear::Gate&, const ImplicitKindBuffers&, const Pass&) const;
    void record_solids(Recorder&, const linear::Gate&, const Pass&) const;
    ImplicitBuffers at_;
};

} // namespace taut
