// Matrices of other people: each format and precision ends in a word that is true.

#include "linear_hard/cases.hpp"

using namespace taut;
using namespace taut::linear;

namespace {

struct Known
{
    const char* file;
    bool easy; ///< solved to 1e-8 in double and mixed with Jacobi within `iterations`
    std::uint32_t iterations;
};
// Every symmetric positive definite matrix of the folder.
constexpr Known kMatrices[] = {
    {"1138_bus", false, 1500},    {"494_bus", true, 1500},      {"LF10", true, 200},
    {"LFAT5", true, 200},         {"ani4", true, 600},          {"bcsstk13", false, 1500},
    {"bcsstk16", true, 400},      {"fv3", true, 500},           {"gr_30_30", true, 200},
    {"lap3D_7pt_n20", true, 200}, {"mesh1e1", true, 100},       {"msc01050", false, 1500},
    {"nos3", true, 900},          {"pyamg_airfoil", true, 200}, {"pyamg_bar", true, 900}};

struct Loaded
{
    Known known;
    SparseMatrix a;
    Vector exact, b;
};

const std::vector<Loaded>& loaded()
{
    static const std::vector<Loaded> all = [] {
        std::vector<Loaded> out;
        const auto folder = matrix_folder();
        for (const Known& known : kMatrices)
        {
            if (folder.empty())
                break;
            Loaded l{known,
                     read_matrix_market((folder / (std::string(known.file) + ".mtx")).string()).matrix,
                     {},
                     {}};
            Random random(61);
            l.exact = random_vector(random, l.a.rows, 0.5, 1.5);
            l.b = product(l.a, l.exact);
            out.push_back(std::move(l));
        }
        return out;
    }();
    return all;
}

/// Whether a device must take a matrix with as many entries in every row as the longest has: others than the
/// native ones may find its loops too long.
bool holds_ell(const Device& device, const SparseMatrix& a)
{
    std::uint64_t longest = 0;
    for (std::uint32_t row = 0; row < a.rows; ++row)
        longest = std::max<std::uint64_t>(longest, a.row_length(row));
    return device.info().executor.starts_with("cpu") &&
           a.rows * longest * sizeof(double) <= device.limits().max_buffer_bytes;
}

/// Solves and checks the word. Refusals: `limit` by ELL, `bad_input` by blocks where rows do not fit.
void check_word(const std::shared_ptr<Device>& device, const Loaded& l, const SolveOptions& options,
                bool whole)
{
    const auto refusal = code_of([&] {
        const Solution s = solve_checked(device, l.a, l.b, options);
        const Status status = s.report.status;
        CAPTURE(l.known.file, words_of(options), s.report.reason);
        // They are all positive definite: nothing else is true, and a float must not say so either.
        CHECK((status == Status::converged || status == Status::stagnated ||
               status == Status::iteration_limit));
        if (whole && l.known.easy && options.precision != SolvePrecision::float32)
            CHECK(status == Status::converged);
        const std::string what = std::string(l.known.file) + " " + words_of(options);
        note("folder", *device, what + " " + std::string(to_string(status)) + " iterations",
             s.report.iterations);
        note("folder", *device, what + " residual", s.report.relative_residual);
        note("folder", *device, what + " forward error", forward_error(s.x, l.exact));
    });
    CAPTURE(l.known.file, words_of(options));
    if (options.format == Format::bcsr3 && l.a.rows % 3 != 0)
        CHECK(refusal == ErrorCode::bad_input);
    else if (options.format == Format::ell && !holds_ell(*device, l.a))
        CHECK(refusal.value_or(ErrorCode::limit) == ErrorCode::limit);
    else
        CHECK_FALSE(refusal.has_value());
}

/// Dense ones of thousands of rows cost seconds a solve and show nothing more.
bool too_dear(const Loaded& l, Format format) { return format == Format::dense && l.a.rows > 700; }

} // namespace

TEST_CASE("every matrix of the folder ends in a true word in every format and precision")
{
    for (const Loaded& l : loaded())
        for (const Format format : {Format::automatic, Format::dense, Format::coo, Format::csr, Format::ell,
                                    Format::sell, Format::bcsr3})
            for (const SolvePrecision precision : kPrecisions)
            {
                if (too_dear(l, format))
                    continue;
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.max_iterations = l.known.iterations;
                check_word(test_device("cpu:serial"), l, options, true);
            }
}

TEST_CASE("every matrix of the folder ends in a true word on every executor")
{
    std::size_t turn = 0;
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const Loaded& l : loaded())
            for (const SolvePrecision precision : kPrecisions)
            {
                // Formats in turn: each meets each matrix and each precision on some executor.
                const Format format = all_formats()[turn++ % all_formats().size()];
                if (too_dear(l, format) || (!is_cpu(*device) && turn % 2 == 0))
                    continue;
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.max_iterations = is_cpu(*device) ? 300 : driver_iterations(64);
                check_word(device, l, options, false);
            }
        ++turn;
    });
}

TEST_CASE("a stiffness matrix of a dam: sell, mixed, jacobi reach a true 1e-8")
{
    if (loaded().empty())
        TAUT_LEFT_OUT("no matrices: the stiffness matrix of a dam");
    for (const Loaded& l : loaded())
    {
        if (std::string(l.known.file) != "bcsstk16")
            continue;
        SolveOptions options;
        options.format = Format::sell;
        options.precision = SolvePrecision::mixed;
        options.preconditioner = Preconditioner::jacobi;
        options.tolerance = 1e-8;
        std::optional<Solution> first;
        on_every_device([&](const std::shared_ptr<Device>& device) {
            const Solution s = solve_checked(device, l.a, l.b, options);
            CAPTURE(s.report.reason);
            CHECK(s.report.status == Status::converged);
            CHECK(judged_residual(l.a, s.x, l.b) <= 1e-8);
            note("demonstration", *device, "iterations", s.report.iterations);
            note("demonstration", *device, "true residual", s.report.relative_residual);
            if (!first)
                first = s;
            if (bitwise_equal_expected(device->info()))
                CHECK(same_bits(first->x, s.x));
        });
    }
}

TEST_CASE("a singular matrix does not say converged unless it is")
{
    const auto folder = matrix_folder();
    if (folder.empty())
        return;
    const SparseMatrix a = read_matrix_market((folder / "pyamg_unit_square.mtx").string()).matrix;
    Random random(62);
    const Vector exact = random_vector(random, a.rows), consistent = product(a, exact);
    Vector b = random_vector(random, a.rows);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : {Format::automatic, Format::csr, Format::sell})
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-9;
                options.max_iterations = is_cpu(*device) ? 2000 : 200;
                CAPTURE(words_of(options));
                // Inconsistent: refused, or not converged.
                const auto code = code_of([&] {
                    const Solution s = solve_checked(device, a, b, options);
                    CHECK(s.report.status != Status::converged);
                });
                CHECK(code.value_or(ErrorCode::bad_input) == ErrorCode::bad_input);
                // Consistent to rounding: solved, and the note says that A is singular.
                const Solution s = solve_checked(device, a, consistent, options);
                CAPTURE(s.report.reason);
                CHECK(s.report.status == Status::converged);

                options.null_space = NullSpace::constants;
                const Solution projected = solve(device, a, b, options);
                CAPTURE(projected.report.reason);
                CHECK(projected.report.status == Status::converged);
                double mean = 0;
                for (const double entry : b)
                    mean += entry / a.rows;
                Vector rest = b;
                for (double& entry : rest)
                    entry -= mean;
                CHECK(judged_residual(a, projected.x, rest) <= 1.0001 * options.tolerance);
            }
    });
}
