// The 7-point Poisson problem against Eigen, ViennaCL, a loop written for it, and the speed of memory.

#include "linear_device.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace bench {

using namespace taut::linear;

namespace {

constexpr int kThreads = 2; // the targets are for two cores
constexpr int kMostIterations = 5000;
constexpr int kProductTurns = 30;
constexpr std::size_t kCopyBytes = std::size_t{512}
                                   << 20; // far beyond any last-level cache; twice that is touched

struct Peer
{
    std::string name;
    std::unique_ptr<Solver> solver;
    int iterations = 0;
    double residual = 0, error = 0;
    double median = 0, best = 0; // ms of a whole solve

    double per_iteration() const { return median / iterations; }
};

std::vector<Peer> make_peers(const System& system, const PeersOptions& options)
{
    std::vector<Peer> peers;
    const auto add = [&](const std::string& name, auto make) {
        if (name.find(options.only) == std::string::npos)
            return;
        if (std::unique_ptr<Solver> solver = make())
            peers.push_back({name, std::move(solver)});
        else
            std::fprintf(stderr, "left out: %s (not in this build)\n", name.c_str());
    };
    add("taut csr double",
        [&] { return device_solver("cpu", system, Format::csr, SolvePrecision::float64); });
    add("taut csr mixed", [&] { return device_solver("cpu", system, Format::csr, SolvePrecision::mixed); });
    add("taut sell double",
        [&] { return device_solver("cpu", system, Format::sell, SolvePrecision::float64); });
    add("taut matrix-free double", [&] { return matrix_free_solver("cpu", system, options.side); });
    add("plain C++, 2 threads", [&] { return plain_solver(system, kThreads); });
    add("Eigen, 1 thread", [&] { return eigen_solver(system, 1); });
    add("Eigen, 2 threads", [&] { return eigen_solver(system, kThreads); });
    add("ViennaCL, Jacobi", [&] { return viennacl_solver(system, true); });
    add("ViennaCL, its fused iteration", [&] { return viennacl_solver(system, false); });
    return peers;
}

/// Who does not reach what the others reach is not timed.
void check(const System& system, Peer& peer, double tolerance)
{
    peer.iterations = peer.solver->solve(tolerance, kMostIterations);
    const std::vector<double> x = peer.solver->x();
    peer.residual = relative_residual(system.a, x, system.b);
    peer.error = forward_error(x, system.exact);
    if (!(peer.residual <= 1.01 * tolerance))
        throw std::runtime_error(peer.name + " ends with a true residual of " +
                                 taut::shown(peer.residual, 3) + " after " + std::to_string(peer.iterations) +
                                 " iterations, asked for " + taut::shown(tolerance) + ": nothing is timed");
}

void time_solves(std::vector<Peer>& peers, const PeersOptions& options)
{
    std::vector<Rival> rivals;
    for (Peer& peer : peers)
        rivals.push_back({peer.name, [&] { peer.solver->solve(options.tolerance, kMostIterations); }});
    take_turns(rivals, options.turns, 1);
    for (std::size_t i = 0; i < peers.size(); ++i)
    {
        peers[i].median = rivals[i].median();
        peers[i].best = rivals[i].best();
    }
}

struct ProductRow
{
    std::string name;
    double median = 0, best = 0; // ms
    double bytes = 0;            // by the model
    double gb_per_s() const { return bytes / median * 1e-6; }
};

/// Products of everybody who offers them in double, and last the copy.
std::vector<ProductRow> time_products(const System& system, std::vector<Peer>& peers)
{
    std::vector<double> expected(system.a.rows);
    multiply(system.a, system.b, expected);
    const double rows = system.a.rows, entries = static_cast<double>(system.a.nonzeros());
    const double csr_bytes = 12 * entries + 4 * (rows + 1) + 16 * rows;
    std::vector<Rival> rivals;
    std::vector<ProductRow> out;
    for (Peer& peer : peers)
    {
        if (peer.name.find("mixed") != std::string::npos || peer.name.find("fused") != std::string::npos ||
            !peer.solver->product())
            continue;
        const std::vector<double> y = peer.solver->y();
        std::vector<double> difference(y.size());
        for (std::size_t i = 0; i < y.size(); ++i)
            difference[i] = y[i] - expected[i];
        if (!(norm(difference) <= 1e-14 * norm(expected)))
            throw std::runtime_error("the product of " + peer.name + " is another one: nothing is timed");
        rivals.push_back({peer.name, [&] { peer.solver->product(); }});
        const bool free = peer.name.find("matrix-free") != std::string::npos;
        out.push_back({peer.name, 0, 0, free ? 16 * rows : csr_bytes});
    }
    const std::vector<char> from(kCopyBytes / 2, 1);
    std::vector<char> to(kCopyBytes / 2);
    rivals.push_back({"copy", [&] { parallel_copy(to.data(), from.data(), from.size(), kThreads); }});
    out.push_back({"memcpy, 2 threads", 0, 0, static_cast<double>(kCopyBytes)});
    take_turns(rivals, kProductTurns);
    for (std::size_t i = 0; i < out.size(); ++i)
    {
        out[i].median = rivals[i].median();
        out[i].best = rivals[i].best();
    }
    return out;
}

struct Target
{
    std::string who, to;
    double limit;
    bool whole_solve; // else time per iteration
};

const std::vector<Target>& targets()
{
    static const std::vector<Target> all = {
        {"taut csr double", "Eigen, 2 threads", 0.6, false},
        {"taut csr double", "ViennaCL, Jacobi", 0.7, false},
        {"taut csr double", "ViennaCL, its fused iteration", 0.7, false},
        {"taut csr double", "plain C++, 2 threads", 0, false},
        {"taut matrix-free double", "Eigen, 2 threads", 0.2, false},
        {"taut csr mixed", "taut csr double", 0.8, true},
    };
    return all;
}

const Peer* find(const std::vector<Peer>& peers, const std::string& name)
{
    for (const Peer& peer : peers)
        if (peer.name == name)
            return &peer;
    return nullptr;
}

struct Ratio
{
    Target target;
    double value;
};

std::vector<Ratio> ratios_of(const std::vector<Peer>& peers)
{
    std::vector<Ratio> out;
    for (const Target& t : targets())
    {
        const Peer *who = find(peers, t.who), *to = find(peers, t.to);
        if (who && to)
            out.push_back(
                {t, t.whole_solve ? who->median / to->median : who->per_iteration() / to->per_iteration()});
    }
    return out;
}

std::string verdict(double value, double limit, bool at_most)
{
    if (limit <= 0)
        return "";
    const bool met = at_most ? value <= limit : value >= limit;
    return std::string(at_most ? "≤ " : "≥ ") + taut::shown(limit) + (met ? "" : ", missed");
}

void print(const std::vector<Peer>& peers, const std::vector<Ratio>& ratios,
           const std::vector<ProductRow>& products)
{
    std::printf(
        "| whole solve | iterations | ms an iteration, median | best | true residual | forward error |\n"
        "|---|---|---|---|---|---|\n");
    for (const Peer& p : peers)
        std::printf("| %s | %d | %.2f | %.2f | %.2g | %.2g |\n", p.name.c_str(), p.iterations,
                    p.per_iteration(), p.best / p.iterations, p.residual, p.error);
    std::printf("\n| ratio | of | to | value | target |\n|---|---|---|---|---|\n");
    for (const Ratio& r : ratios)
        std::printf("| %s | %s | %s | %.2f | %s |\n",
                    r.target.whole_solve ? "whole solve" : "time an iteration", r.target.who.c_str(),
                    r.target.to.c_str(), r.value, verdict(r.value, r.target.limit, true).c_str());
    const double copy = products.back().gb_per_s();
    std::printf("\n| product y = A x | ms, median | best | GB/s | share of the copy | target |\n"
                "|---|---|---|---|---|---|\n");
    for (const ProductRow& p : products)
        std::printf("| %s | %.2f | %.2f | %.1f | %.2f | %s |\n", p.name.c_str(), p.median, p.best,
                    p.gb_per_s(), p.gb_per_s() / copy,
                    p.name == "taut csr double" ? verdict(p.gb_per_s() / copy, 0.8, false).c_str() : "");
}

std::string csv(const std::vector<Peer>& peers, const std::vector<Ratio>& ratios,
                const std::vector<ProductRow>& products, const std::string& conditions)
{
    std::string text =
        "# " + conditions +
        "\nkind,what,iterations,median_ms,best_ms,true_residual,forward_error,value,to,target\n";
    const auto line = [&](const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i)
            text += (i > 0 ? "," : "") + taut::csv_cell(cells[i]);
        text += '\n';
    };
    const auto number = [](double value) { return taut::shown(value, 6); };
    for (const Peer& p : peers)
        line({"solve", p.name, std::to_string(p.iterations), number(p.median), number(p.best),
              number(p.residual), number(p.error), number(p.per_iteration()), "ms an iteration", ""});
    for (const Ratio& r : ratios)
        line({r.target.whole_solve ? "ratio of solves" : "ratio of iterations", r.target.who, "", "", "", "",
              "", number(r.value), r.target.to, r.target.limit > 0 ? number(r.target.limit) : ""});
    for (const ProductRow& p : products)
        line({"product", p.name, "", number(p.median), number(p.best), "", "", number(p.gb_per_s()), "GB/s",
              ""});
    return text;
}

} // namespace

void run_peers(const PeersOptions& options, const std::string& conditions)
{
    const System system = manufactured("poisson3d", poisson3d(options.side));
    std::vector<Peer> peers = make_peers(system, options);
    for (Peer& peer : peers)
        check(system, peer, options.tolerance);
    time_solves(peers, options);
    const std::vector<ProductRow> products = time_products(system, peers);
    const std::vector<Ratio> ratios = ratios_of(peers);
    print(peers, ratios, products);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv(peers, ratios, products, conditions + "; " + peer_versions()));
}

} // namespace bench
