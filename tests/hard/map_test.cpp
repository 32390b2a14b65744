// F8: every hard case under every method ends as the committed table says, on every executor.
//
// The table changes only when results are meant to. Then tests/hard/update_map.sh rewrites it, and the page
// docs/results/robustness.md, and the commit says why.

#include "hard/map_table.hpp"
#include "support/on_threads.hpp"

#include <atomic>
#include <cstdio>
#include <mutex>

namespace taut::hard {
namespace {

/// One case under one method, as the serial processor ran it.
struct Cell
{
    const MapCase* hard_case;
    MethodKind method;
    Outcome outcome = {};
    std::string name() const
    {
        return hard_case->id + " " + hard_case->what + ", " +
               std::string(words_of<MethodKind>()[static_cast<std::size_t>(method)]);
    }
};

const char* only_id() { return std::getenv("TAUT_MAP_ONLY"); } // rows of one case, for whoever works on it

bool updates() { return environment_has("TAUT_MAP_UPDATE"); }

const std::vector<MapCase>& cases()
{
    static const std::vector<MapCase> list = [] {
        std::vector<MapCase> all = map_cases();
        if (only_id())
            std::erase_if(all, [](const MapCase& c) { return c.id != only_id(); });
        return all;
    }();
    return list;
}

/// For tests/mutants.sh: cells after the first that is not as committed are left out.
bool stops_at_first() { return environment_has("TAUT_MAP_FIRST"); }

/// Empty, or what keeps the cell from being as committed.
std::string as_committed(const std::vector<Row>& table, const Cell& cell)
{
    const Row now = row_of(*cell.hard_case, cell.method, cell.outcome);
    const auto row = std::find_if(table.begin(), table.end(), [&](const Row& r) { return r.same_cell(now); });
    return row == table.end() ? "the table has no such row" : difference(*row, now);
}

/// Cells do not know of each other: one thread a processor, each with a device of its own.
std::vector<Cell> run_all()
{
    std::vector<Cell> cells;
    const std::vector<Row> table = read_table(table_file(short_run()));
    for (const MapCase& c : cases())
        for (std::size_t m = 0; m < words_of<MethodKind>().size(); ++m)
            cells.push_back({&c, static_cast<MethodKind>(m)});
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        const std::shared_ptr<Device> device = Device::open("cpu:serial", {});
        for (std::size_t k = next++; k < cells.size(); k = next++)
        {
            Cell& cell = cells[k];
            cell.outcome = judged(*cell.hard_case, cell.method, device);
            if (stops_at_first() && !as_committed(table, cell).empty())
                next = cells.size();
        }
    };
    on_threads(processors(), work);
    return cells;
}

/// Run once a process, by whichever test asks first.
const std::vector<Cell>& all_cells()
{
    static const std::vector<Cell> cells = run_all();
    return cells;
}

/// The rows of this run in place of those of the table, which keeps what was not run: other cases, if one
/// was chosen, and those whose data is not there.
std::vector<Row> merged(const std::vector<Row>& old)
{
    std::vector<Row> rows;
    const auto kept = [&](const Row& row) {
        return std::none_of(cases().begin(), cases().end(),
                            [&](const MapCase& c) { return c.id == row.id && c.what == row.what; }) &&
               (only_id() ? row.id != only_id() : row.id == kDataCase);
    };
    std::vector<Row> fresh;
    for (const Cell& cell : all_cells())
        fresh.push_back(row_of(*cell.hard_case, cell.method, cell.outcome));
    for (const Row& row : only_id() ? old : fresh) // one case goes back to where it stood
    {
        const auto now = std::ranges::find_if(fresh, [&](const Row& r) { return r.same_cell(row); });
        if (now != fresh.end())
            rows.push_back(*now);
        else if (kept(row))
            rows.push_back(row);
    }
    for (const Row& row : only_id() ? fresh : old) // new rows, or those whose data is not here
        if (std::ranges::none_of(rows, [&](const Row& r) { return r.same_cell(row); }) &&
            (only_id() || kept(row)))
            rows.push_back(row);
    return rows;
}

/// Of the executors other than cpu:serial, how many steps of a cell are compared. None: left out.
int steps_elsewhere(const Cell& cell, const std::string& selector)
{
    const int all = steps_of(*cell.hard_case);
    if (cell.hard_case->check && cell.outcome.refused()) // by what the check makes, before a step
        return all;
    if (!short_run())
        return all;
    std::size_t vertices = 0;
    for (const Body& body : cell.hard_case->scene.bodies)
        vertices += body.mesh.positions.size();
    const auto more = cell.hard_case->effort.find(cell.method);
    const std::size_t cost = more == cell.hard_case->effort.end() ? 1 : more->second.cost();
    const bool whole = vertices * static_cast<std::size_t>(all) * cost <= 2000;
    if (selector.starts_with("cpu"))
        return whole ? all : kStepsShort;
    return cell.hard_case->compares_bits ? all : whole && selector == "vulkan" ? 1 : 0;
}

/// Empty, or how the cell went other than on cpu:serial.
std::string departure(const Cell& cell, const Outcome& there)
{
    const Outcome& here = cell.outcome;
    if (here.refused() || there.refused())
        return here.verdict == there.verdict ? "" : here.verdict + " on cpu:serial, here " + there.verdict;
    for (const auto& [step, hash] : there.hashes)
        if (const auto found = here.hashes.find(step); found != here.hashes.end() && found->second != hash)
            return "other positions after step " + std::to_string(step);
    for (std::size_t k = 0; k < there.own.size(); ++k)
        if (there.own[k].value != here.own[k].value)
            return there.own[k].what + " " + std::to_string(there.own[k].value) + ", on cpu:serial " +
                   std::to_string(here.own[k].value);
    return {};
}

/// How the cells went on another executor.
struct Comparison
{
    std::size_t compared = 0;       ///< hashes of positions, and refusals
    std::vector<std::string> other; ///< what went other than on cpu:serial, a line a cell
};

/// Every so many cells; one thread a processor where the executor is a driver, which leaves most of one idle.
Comparison comparison(const std::string& selector, std::size_t stride)
{
    const std::vector<Cell>& cells = all_cells();
    const bool native = selector.starts_with("cpu");
    Comparison out;
    std::mutex mutex;
    std::atomic<std::size_t> next = 0;
    on_threads(native ? 1 : processors(), [&] {
        const std::shared_ptr<Device> device = open_test_device(selector);
        for (std::size_t k = next.fetch_add(stride); k < cells.size(); k = next.fetch_add(stride))
            if (const int steps = steps_elsewhere(cells[k], selector); steps > 0)
            {
                const Outcome there = repeated(*cells[k].hard_case, cells[k].method, device, steps,
                                               native ? 0 : kDispatchesElsewhere);
                const std::string found = departure(cells[k], there);
                const std::lock_guard lock(mutex);
                out.compared += there.hashes.size() + (there.refused() ? 1 : 0);
                if (!found.empty())
                    out.other.push_back(cells[k].name() + ": " + found);
            }
        const std::lock_guard lock(mutex);
        if (const auto messages = device->counters().validation_messages; messages > 0)
            out.other.push_back(std::to_string(messages) + " validation messages");
    });
    return out;
}

} // namespace

TEST_CASE("F8: every cell of the robustness map is as committed [hard]")
{
    const std::filesystem::path file = table_file(short_run());
    all_cells();
    if (updates()) // read only now: another process may have written other rows
        write_table(file, merged(read_table(file)));
    const std::vector<Row> table = read_table(file);
    for (const Cell& cell : all_cells())
        if (!cell.outcome.verdict.empty())
        {
            INFO(cell.name());
            CHECK(as_committed(table, cell) == "");
        }
        else
            CHECK(stops_at_first());
    for (const Row& row : table)
    {
        INFO(row.id << " " << row.what << ": a row of no case");
        CHECK((only_id() || row.id == kDataCase ||
               std::any_of(cases().begin(), cases().end(),
                           [&](const MapCase& c) { return c.id == row.id && c.what == row.what; })));
    }
}

TEST_CASE("F8: the cells end in the same bits on every executor [hard]")
{
    REQUIRE(!all_cells().empty()); // all that is asserted where no other executor is
    for (const std::string& selector : test_devices())
    {
        if (selector == "cpu:serial" || (short_run() && selector.starts_with("opengl")))
            continue;
        // A dispatch of a software driver costs thousands of times its work: there a short run takes every
        // seventh cell, of each case about one method; on the processor every third or fourth.
        const bool shuffled = selector == "cpu:shuffled";
        const std::size_t stride = !short_run() ? 1 : selector == "cpu" ? 3 : shuffled ? 4 : 7;
        INFO(selector);
        const Comparison found = comparison(selector, stride);
        for (const std::string& line : found.other)
            FAIL_CHECK(line);
        CHECK(found.compared > 0);
        if (environment_has("TAUT_NOTES"))
            std::printf("F8 | %s | %zu hashes and refusals\n", selector.c_str(), found.compared);
    }
}

TEST_CASE("F8: the page of the robustness map shows its table [hard]")
{
    const std::string page = page_of(read_table(table_file(false)));
    if (updates())
        put_page_part(page);
    CHECK(page_part() == page);
}

TEST_CASE("F8: no row of the robustness map says FAIL [hard]")
{
    for (const Row& row : read_table(table_file(short_run())))
    {
        INFO(row.id << " " << row.what << ", " << row.method << ": " << row.criterion);
        CHECK(row.verdict != "FAIL");
        // A false alarm, if nothing else is wrong. After the few steps of a short run nothing has to be.
        if (row.verdict.starts_with("stops") && !short_run())
            CHECK(row.number.value_or(0) > row.limit.value_or(0));
    }
}

} // namespace taut::hard
