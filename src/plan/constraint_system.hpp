#pragma once
// Internal to src/plan: the system (J W J^T + compliance) x = b of implicit constraints, as an operator that
// needs no matrix and as one that is assembled on the device.

#include "taut/linear/device_matrix.hpp"
#include "taut/plan/springs.hpp"

namespace taut {

/// Rows of four corners behind those of springs, tetrahedra and then hinges; count 0: none.
struct CornerRows
{
    std::uint32_t count = 0;
    std::uint32_t records = kNoBuffer;  ///< layout::VolumeConstraint<real> or BendingConstraint<real> a row
    std::uint32_t start = kNoBuffer;    ///< rows at each vertex, as in springs.hpp
    std::uint32_t incident = kNoBuffer;
    std::uint32_t gradient = kNoBuffer; ///< 3 rvec4 a row
};

/// Where the rows of a system lie, numbers of plan buffers.
struct ConstraintRows
{
    std::uint32_t count = 0;             ///< most rows of springs there may be
    std::uint32_t records = kNoBuffer;   ///< layout::Spring<real> a row; stiffness 0 = rigid
    std::uint32_t start = kNoBuffer;     ///< springs at each vertex, as in springs.hpp
    std::uint32_t incident = kNoBuffer;
    std::uint32_t direction = kNoBuffer; ///< rvec4 a row
    std::uint32_t spread = kNoBuffer;    ///< rvec4 a vertex: w J^T x
    // Only where rows are a changing part of the springs (acad):
    std::uint32_t list = kNoBuffer;  ///< how many vertices have rows, then these
    std::uint32_t place = kNoBuffer; ///< row of each spring
    CornerRows corners;
    std::uint32_t all() const { return count + corners.count; }
};

/// y = J (W (J^T x)) + compliance x by two gathering passes, and two more where there are rows of four
/// corners.
class ConstraintOperator final : public linear::Operator
{
public:
    ConstraintOperator(PlanBuilder& builder, const ConstraintRows& rows);

    std::uint32_t rows() const override { return rows_.all(); }
    Precision precision() const override { return precision_; }
    std::uint64_t bytes() const override { return bytes_; }
    void record_product(Recorder&, const linear::Gate&, Binding x, Binding y,
                        Binding partials) const override;
    void record_residual(Recorder&, const linear::Gate&, Binding x, Binding b, Binding r) const override;

private:
    void record_spread(Recorder&, const linear::Gate&, Binding x) const;
    struct Pass
    {
        std::string_view variant;
        Binding x, y, partials, b; ///< the last two where the variant has them
    };
    void record_rows(Recorder&, const linear::Gate&, const Pass&) const;

    ConstraintRows rows_;
    Precision precision_;
    std::uint32_t vertices_;
    std::uint64_t bytes_ = 0;
    BufferPtr records_, start_, incident_, direction_, position_, spread_, list_, place_;
    BufferPtr corners_, corner_start_, corner_incident_, gradient_; ///< null: no rows of four corners
};

/// The pattern of A, and what never changes of its values: sum of s_r s_s w_k over the vertices that two
/// rows share. Row-major, columns ascending, each row with its diagonal.
/// Throws Error{limit} beyond 2^26 entries, naming their number.
linear::SparseMatrix constraint_pattern(std::span<const StretchElement> rows, const Incidence& at,
                                        std::span<const double> inverse_mass);

/// The same where rows of four corners stand behind those of springs, with the terms that each entry adds up.
struct ConstraintTerms
{
    linear::SparseMatrix pattern;            ///< values 0
    std::vector<std::uint32_t> start = {0};  ///< entries + 1
    std::vector<std::uint32_t> address;      ///< two a term, kernels/shared/corner_address.h
    std::vector<double> weight;              ///< 1/kg a term
};
/// `corners` lists four vertices a row, `corners_at` them at each vertex. Throws as constraint_pattern.
ConstraintTerms constraint_terms(std::span<const StretchElement> springs, const Incidence& at,
                                 std::span<const std::uint32_t> corners, const Incidence& corners_at,
                                 std::span<const double> inverse_mass);

/// The matrix on paper, with the pass that fills it.
class ConstraintMatrix
{
public:
    ConstraintMatrix(PlanBuilder& builder, std::string_view effect, const linear::SparseMatrix& pattern,
                     std::uint32_t direction);
    ConstraintMatrix(PlanBuilder& builder, std::string_view effect, const ConstraintTerms& terms,
                     std::uint32_t direction, std::uint32_t gradient);
    const std::shared_ptr<linear::DeviceMatrix>& matrix() const { return matrix_; }
    void record(PlanBuilder& builder) const;

private:
    std::string effect_;
    std::shared_ptr<linear::DeviceMatrix> matrix_;
    std::uint32_t pair_ = kNoBuffer, weight_ = kNoBuffer, direction_ = kNoBuffer, values_ = kNoBuffer;
    std::uint32_t start_ = kNoBuffer, gradient_ = kNoBuffer; ///< only with rows of four corners
    std::uint32_t entries_ = 0, terms_ = 0;
};

} // namespace taut
