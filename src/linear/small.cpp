// Based on: kernels/linear/cg_small.comp (what is done), kernels/shared/cg_state.glsl (what is decided).
// Departures: none beyond those named there.

#include "taut/linear/small.hpp"
#include "taut/linear/cg_state.hpp"
#include "taut/linear/check.hpp"
#include "taut/linear/reals.hpp"
#include "taut/runtime/base/shown.hpp"

#include "taut/kernels/cg_small.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace taut::linear {
namespace {

constexpr std::uint32_t kHistory = ConjugateGradient::kHistory;
constexpr std::uint32_t kControl = 1 + kHistory; ///< words a system
constexpr std::uint32_t kTableWords = 3;         ///< words a system, before the row starts

/// Trips of a loop of `count` turns: lavapipe counts the last look at the condition too.
std::uint64_t loop_trips(std::uint64_t count) { return count + 1; }

/// Trips of the busiest invocation. Lanes of one vector wait for each other, so each tile of 128 rows
/// counts with its longest row.
std::uint64_t product_trips(const SparseMatrix& a)
{
    std::uint64_t trips = 0;
    for (std::uint32_t tile = 0; tile < a.rows; tile += TAUT_LINEAR_GROUP)
    {
        std::uint32_t longest = 0;
        for (std::uint32_t row = tile; row < std::min<std::uint32_t>(a.rows, tile + TAUT_LINEAR_GROUP); ++row)
            longest = std::max(longest, a.row_length(row));
        trips += loop_trips(longest);
    }
    return trips;
}

/// Iterations, or residuals formed anew, that one dispatch of cg_small.comp has room for.
std::uint64_t turns_of(const SparseMatrix& a)
{
    const std::uint64_t sweep = loop_trips((a.rows + TAUT_LINEAR_GROUP - 1) / TAUT_LINEAR_GROUP);
    const std::uint64_t tree = loop_trips(std::bit_width(std::uint32_t{TAUT_LINEAR_GROUP}) - 1);
    const std::uint64_t turn = 1 + product_trips(a) + 3 * sweep + 2 * tree;
    const std::uint64_t frame = 1 + 2 * sweep;
    return (kMaxLoopTrips - frame) / turn;
}

[[noreturn]] void refuse(ErrorCode code, std::size_t system, const std::string& sentence)
{
    throw Error(code, "system " + std::to_string(system) + " of the batch (from 0) " + sentence);
}

void check(const SparseMatrix& a, std::span<const double> inverse, std::size_t k)
{
    if (a.rows != a.columns)
        refuse(ErrorCode::bad_input, k,
               "has " + std::to_string(a.rows) + " rows and " + std::to_string(a.columns) +
                   " columns: a square one is wanted");
    if (inverse.size() != a.rows)
        refuse(ErrorCode::bad_input, k,
               "has " + std::to_string(a.rows) + " rows, but its inverse diagonal " +
                   std::to_string(inverse.size()) + " values: one a row is wanted");
    if (a.rows > kSmallRows)
        refuse(ErrorCode::limit, k,
               "has " + std::to_string(a.rows) + " rows, but one work group takes " +
                   std::to_string(kSmallRows) + " at most: take ConjugateGradient");
    if (turns_of(a) == 0)
        refuse(ErrorCode::limit, k,
               "has rows so long that one iteration needs more than " + std::to_string(kMaxLoopTrips) +
                   " loop trips: take ConjugateGradient");
}

/// values times 2^exponent as `Real`, and what that leaves over.
struct SplitValues
{
    std::vector<double> high, low;

    void add(double v, Precision precision)
    {
        const bool wide = precision == Precision::float64;
        const double rounded = wide ? v : static_cast<double>(static_cast<float>(v));
        high.push_back(rounded);
        low.push_back(std::isfinite(rounded) ? v - rounded : 0);
    }
};

} // namespace

struct SmallBatch::Parts
{
    std::shared_ptr<Device> device;
    Precision precision = Precision::float64;
    bool pairs = false;
    std::uint32_t rows = 0, entries = 0;           ///< of all systems
    std::vector<std::uint32_t> first, size, turns; ///< a system
    BufferPtr table, column, value, given, base, work, state, control;
    std::unique_ptr<Recording> pass;
    CgSettings settings;
    std::vector<CgOutcome> outcomes;     ///< after run
    std::vector<double> checked, gained; ///< read when first asked for

    BufferPtr make(std::uint64_t bytes, std::string_view label) const
    {
        return device->make_buffer(std::max<std::uint64_t>(bytes, 8), label);
    }

    template <typename T>
    BufferPtr upload(std::span<const T> values, std::string_view label) const
    {
        BufferPtr buffer = make(values.size_bytes(), label);
        if (!values.empty())
            device->write<T>(buffer, values);
        return buffer;
    }

    void upload_systems(std::span<const SparseMatrix>, std::span<const int> exponents);
    void upload_inverses(std::span<const std::vector<double>>);
    void record();
    template <typename Real>
    void write_states() const;
    template <typename Real>
    bool read_states();
    void fetch();
};

void SmallBatch::Parts::upload_systems(std::span<const SparseMatrix> systems, std::span<const int> exponents)
{
    std::vector<std::uint32_t> words, starts = {0}, columns;
    SplitValues values;
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        const SparseMatrix& a = systems[k];
        const std::uint64_t places = std::numeric_limits<std::uint32_t>::max() / 4;
        if (columns.size() + a.nonzeros() > places || kTableWords * systems.size() + rows + a.rows > places)
            refuse(ErrorCode::limit, k, "does not fit the 32-bit places of one batch: make two batches");
        first.push_back(rows);
        size.push_back(a.rows);
        turns.push_back(static_cast<std::uint32_t>(turns_of(a)));
        words.insert(words.end(), {rows, a.rows, turns.back()});
        for (std::uint32_t row = 0; row < a.rows; ++row)
            starts.push_back(starts.back() + a.row_length(row));
        columns.insert(columns.end(), a.column.begin(), a.column.end());
        for (const double v : a.value)
        {
            values.add(std::ldexp(v, exponents[k]), precision);
            if (!std::isfinite(values.high.back()))
                refuse(ErrorCode::bad_input, k,
                       "has the value " + std::to_string(v) + " that times 2^" +
                           std::to_string(exponents[k]) + " overflows: take DeviceMatrix::scale_exponent");
        }
        rows += a.rows;
    }
    entries = starts.back();
    words.insert(words.end(), starts.begin(), starts.end());
    table = upload<std::uint32_t>(words, "small table");
    column = upload<std::uint32_t>(columns, "small columns");
    value = make(values.high.size() * (pairs ? 2 : 1) * real_bytes(precision), "small values");
    write_reals(*device, value, values.high, precision, 0);
    if (pairs)
        write_reals(*device, value, values.low, precision, values.high.size());
}

void SmallBatch::Parts::upload_inverses(std::span<const std::vector<double>> inverses)
{
    const std::uint64_t real = real_bytes(precision);
    given = make(rows * real * (pairs ? 3 : 2), "small b and inverse");
    std::vector<double> all;
    all.reserve(rows);
    for (const std::vector<double>& inverse : inverses)
        all.insert(all.end(), inverse.begin(), inverse.end());
    write_reals(*device, given, all, precision, 0);
}

void SmallBatch::Parts::record()
{
    const std::uint64_t real = real_bytes(precision), systems = first.size();
    base = make(rows * real * (pairs ? 2 : 1), "small solution");
    work = make(4 * rows * real, "small vectors");
    state = make(systems * (real == 4 ? sizeof(layout::CgState<float>) : sizeof(layout::CgState<double>)),
                 "small states");
    control = make(systems * kControl * 4, "small history");
    Recorder recorder(device);
    recorder.dispatch(kernels::cg_small::Bindings<Recorder::Binding>{.table = table,
                                                                     .column = column,
                                                                     .value = value,
                                                                     .given = given,
                                                                     .base = base,
                                                                     .work = work,
                                                                     .state = state,
                                                                     .control = control},
                      {static_cast<std::uint32_t>(systems), rows, entries, kHistory},
                      static_cast<std::uint32_t>(systems), {pairs ? "pairs" : "", precision, "cg_small"});
    pass = recorder.finish();
}

template <typename Real>
void SmallBatch::Parts::write_states() const
{
    const std::vector<layout::CgState<Real>> states(first.size(), first_state<Real>(settings));
    device->write<layout::CgState<Real>>(state, states);
}

/// Returns whether all have ended.
template <typename Real>
bool SmallBatch::Parts::read_states()
{
    outcomes.clear();
    for (const auto& s : device->read<layout::CgState<Real>>(state, first.size()))
        outcomes.push_back(outcome_of(s));
    return std::none_of(outcomes.begin(), outcomes.end(), [](const CgOutcome& o) { return o.running; });
}

void SmallBatch::Parts::fetch()
{
    if (outcomes.empty())
        throw Error(ErrorCode::bad_input, "nothing was solved yet: call start and run first");
    if (!checked.empty() || rows == 0)
        return;
    checked = read_reals(*device, base, rows, precision, 0);
    if (pairs)
    {
        const std::vector<double> low = read_reals(*device, base, rows, precision, rows);
        for (std::size_t i = 0; i < checked.size(); ++i)
            checked[i] += low[i];
    }
    gained = read_reals(*device, work, rows, precision, 3ull * rows);
}

SmallBatch::SmallBatch(std::shared_ptr<Device> device, std::span<const SparseMatrix> systems,
                       std::span<const int> exponents, std::span<const std::vector<double>> inverses,
                       Precision precision, bool pairs)
    : parts_(std::make_shared<Parts>())
{
    if (systems.empty() || systems.size() != exponents.size() || systems.size() != inverses.size())
        throw Error(ErrorCode::bad_input,
                    "a batch wants at least one system, and an exponent and an inverse for each: there are " +
                        std::to_string(systems.size()) + " systems, " + std::to_string(exponents.size()) +
                        " exponents and " + std::to_string(inverses.size()) + " inverses");
    if (precision == Precision::float64)
        require_float64(device->info());
    if (pairs && precision != Precision::float32)
        throw Error(ErrorCode::bad_input, "pairs are made of floats: take pairs with float");
    for (std::size_t k = 0; k < systems.size(); ++k)
        check(systems[k], inverses[k], k);
    parts_->device = std::move(device);
    parts_->precision = precision;
    parts_->pairs = pairs;
    parts_->upload_systems(systems, exponents);
    parts_->upload_inverses(inverses);
    parts_->record();
}

void SmallBatch::set(const CgSettings& settings)
{
    check_settings(settings);
    parts_->settings = settings;
}

void SmallBatch::start(std::span<const double> b, std::span<const double> x0)
{
    Parts& p = *parts_;
    if (b.size() != p.rows || (!x0.empty() && x0.size() != p.rows))
        throw Error(ErrorCode::bad_input, "the batch has " + counted(p.rows, "row", "rows") + ", but b has " +
                                              counted(b.size(), "entry", "entries") + " and x0 " +
                                              std::to_string(x0.size()) + ": one a row is wanted");
    SplitValues right, guess;
    for (std::size_t i = 0; i < b.size(); ++i)
    {
        right.add(b[i], p.precision);
        guess.add(x0.empty() ? 0 : x0[i], p.precision);
    }
    write_reals(*p.device, p.given, right.high, p.precision, p.rows);
    write_reals(*p.device, p.base, guess.high, p.precision, 0);
    if (p.pairs)
    {
        write_reals(*p.device, p.given, right.low, p.precision, 2ull * p.rows);
        write_reals(*p.device, p.base, guess.low, p.precision, p.rows);
    }
    if (p.precision == Precision::float32)
        p.write_states<float>();
    else
        p.write_states<double>();
    std::vector<std::uint32_t> control(p.first.size() * kControl, 0u);
    for (std::size_t k = 0; k < p.first.size(); ++k)
        control[k * kControl] = 1; // the residual is wanted
    p.device->write<std::uint32_t>(p.control, control);
    p.outcomes.clear();
}

std::uint32_t SmallBatch::run()
{
    Parts& p = *parts_;
    p.checked.clear();
    std::uint32_t dispatches = 0;
    bool ended = false;
    while (!ended)
    {
        p.pass->replay();
        ++dispatches;
        ended = p.precision == Precision::float32 ? p.read_states<float>() : p.read_states<double>();
    }
    return dispatches;
}

std::size_t SmallBatch::systems() const { return parts_->first.size(); }

std::uint32_t SmallBatch::rows() const { return parts_->rows; }

std::uint32_t SmallBatch::turns(std::size_t system) const { return parts_->turns.at(system); }

std::uint64_t SmallBatch::bytes() const
{
    const Parts& p = *parts_;
    std::uint64_t sum = 0;
    for (const BufferPtr& buffer : {p.table, p.column, p.value, p.given, p.base, p.work, p.state, p.control})
        sum += buffer->bytes();
    return sum;
}

CgOutcome SmallBatch::outcome(std::size_t system)
{
    parts_->fetch();
    return parts_->outcomes.at(system);
}

std::vector<double> SmallBatch::checked_x(std::size_t system)
{
    parts_->fetch();
    const auto from = parts_->checked.begin() + parts_->first.at(system);
    return {from, from + parts_->size[system]};
}

std::vector<double> SmallBatch::x(std::size_t system)
{
    std::vector<double> sum = checked_x(system);
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += parts_->gained[parts_->first[system] + i];
    return sum;
}

std::vector<double> SmallBatch::direction(std::size_t system)
{
    const Parts& p = *parts_;
    return read_reals(*p.device, p.work, p.size.at(system), p.precision,
                      std::uint64_t{p.rows} + p.first[system]);
}

std::vector<float> SmallBatch::history(std::size_t system)
{
    Parts& p = *parts_;
    const std::uint32_t last = outcome(system).iterations;
    const std::uint64_t at = (std::uint64_t{kControl} * system + 1) * 4;
    const std::vector<std::uint32_t> words = p.device->read<std::uint32_t>(p.control, kHistory, at);
    std::vector<float> out;
    for (std::uint32_t k = last - std::min(last, kHistory - 1); k <= last; ++k)
        out.push_back(std::bit_cast<float>(words[k % kHistory]));
    return out;
}

} // namespace taut::linear
