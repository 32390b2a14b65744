#pragma once
// Inside of DeviceMatrix: one maker for each format, and what the formats share. Not installed.

#include "taut/linear/device_matrix.hpp"

#include <functional>
#include <string>

namespace taut::linear {

/// What every format is: tables that stay, values, and a kernel with the variants "" (y = A x), "dot"
/// (partials too), "residual" (r = b - A x) and "residual_pairs" (the same in two floats).
///
/// Every kernel binds tables of the pattern, `values`, `x` and `y` (the result), and for "dot" `partials`,
/// for "residual" `b`, for "residual_pairs" `b` and `low`, the low words of the values.
class PackedMatrix : public DeviceMatrix
{
public:
    std::uint32_t rows() const final { return rows_; }
    Precision precision() const final { return precision_; }
    Format format() const final { return format_; }
    BufferPtr values() const final { return values_; }
    std::uint64_t bytes() const final { return bytes_; }

    void record_product(Recorder&, const Gate&, Binding x, Binding y, Binding partials) const final;
    void record_residual(Recorder&, const Gate&, Binding x, Binding b, Binding r) const final;
    void record_residual_pairs(Recorder&, const Gate&, Binding x, Binding b, Binding r) const final;

protected:
    /// `format` as upload was asked for. The matrix is square (upload checked it).
    PackedMatrix(const std::shared_ptr<Device>&, const SparseMatrix&, const UploadOptions&);

    struct Pass
    {
        std::string_view variant;
        Binding x, y, partials, b; ///< the last two where the variant has them
    };
    virtual void record(Recorder&, const Gate&, const Pass&) const = 0;

    /// A table of the pattern on the device (at least one word); counted in bytes(). Throws Error{limit}
    /// naming format, what it is and its bytes where it is larger than the device's buffers may be.
    BufferPtr upload_table(std::span<const std::uint32_t> table, std::string_view what);

    /// values() of `count` entries, zero but for value k of the matrix times 2^exponent at slots[k]; low
    /// words where options ask for pairs of values that stay, and any value needs one. Throws Error{limit} as
    /// above, and Error{bad_input} for a value that float cannot hold.
    void upload_values(const SparseMatrix&, std::span<const std::uint32_t> slots, std::uint64_t count);

    /// The bindings of a pass: `tables` and all that the formats share.
    template <template <typename> typename Bindings>
    Bindings<Binding> bindings(Bindings<Binding> tables, const Pass& pass) const
    {
        tables.values = values_;
        tables.x = pass.x;
        tables.y = pass.y;
        if constexpr (requires { tables.partials; })
            tables.partials = pass.partials;
        tables.b = pass.b;
        if (pass.variant == "residual_pairs")
            tables.low = low_words();
        return tables;
    }

    /// Whether values have low words: the parameter `low_words` of "residual_pairs". Without, the values are
    /// bound again in their place and the kernel must not read them.
    bool has_low_words() const { return low_ != nullptr; }
    BufferPtr low_words() const { return low_ ? low_ : values_; }

    /// Throws Error{limit} where a buffer of `wanted` bytes is more than the device allows.
    void check_bytes(std::uint64_t wanted, std::string_view what) const;

    /// Throws Error{limit} where a lane of group g, which loops `trips(begin, end)` times for 128 rows
    /// (units) from `begin` on, would loop more often than kMaxLoopTrips in a dispatch. Native code loops as
    /// long as it likes.
    void check_trips(std::uint32_t units,
                     const std::function<std::uint64_t(std::uint32_t begin, std::uint32_t end)>& trips) const;

    /// Straight loops over memory are best: no shared memory, no limit of trips.
    bool is_native() const { return device_->info().executor.starts_with("cpu"); }

    const std::shared_ptr<Device> device_;

private:
    const std::uint32_t rows_;
    const Precision precision_;
    const Format format_;
    const bool keeps_low_;
    const int exponent_;
    BufferPtr values_, low_;
    std::uint64_t bytes_ = 0;
};

/// Rows of csr with more entries are taken by a whole group each.
inline constexpr std::uint32_t kLongRow = 512;
/// Entries of a row of csr: a lane's share of them and a tree of sums within kMaxLoopTrips.
inline constexpr std::uint32_t kLongestCsrRow = (kMaxLoopTrips - 10) * TAUT_LINEAR_GROUP;

/// Where SELL-32-256 puts rows and entries.
struct SellLayout
{
    static constexpr std::uint32_t kSlice = 32;
    static constexpr std::uint32_t kWindow = 256;
    std::vector<std::uint32_t> order;       ///< the row at each place
    std::vector<std::uint64_t> slice_start; ///< slices + 1, in entries
    std::uint64_t entries() const { return slice_start.back(); }
};
SellLayout sell_layout(const SparseMatrix&);

/// Called by DeviceMatrix::upload, which has checked what does not depend on the format (square, at least one
/// row, precision of the device, pairs with float only).
std::shared_ptr<DeviceMatrix> make_dense(const std::shared_ptr<Device>&, const SparseMatrix&,
                                         const UploadOptions&);
std::shared_ptr<DeviceMatrix> make_coo(const std::shared_ptr<Device>&, const SparseMatrix&,
                                       const UploadOptions&);
std::shared_ptr<DeviceMatrix> make_csr(const std::shared_ptr<Device>&, const SparseMatrix&,
                                       const UploadOptions&);
std::shared_ptr<DeviceMatrix> make_ell(const std::shared_ptr<Device>&, const SparseMatrix&,
                                       const UploadOptions&);
std::shared_ptr<DeviceMatrix> make_sell(const std::shared_ptr<Device>&, const SparseMatrix&,
                                        const UploadOptions&);
std::shared_ptr<DeviceMatrix> make_bcsr3(const std::shared_ptr<Device>&, const SparseMatrix&,
                                         const UploadOptions&);

} // namespace taut::linear
