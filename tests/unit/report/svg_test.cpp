#include "support/catch.hpp"

#include "taut/report/svg_plot.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

using namespace taut;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Plot sample()
{
    Plot plot;
    plot.title = "Hanging cloth, 32 x 32: error against time";
    plot.x_label = "device time per simulated second [ms]";
    plot.y_label = "e_traj [1]";
    plot.series = {
        {"xpbd float, 1 iteration", {{2, 0.4, "4x1"}, {4, 0.1, "8x1"}, {8, 0.03, "16x1"}, {16, 0.007, "32x1"},
                                     {33, 0.0021, "64x1"}, {70, 0.011, "128x1"}}},
        {"xpbd float, 4 iterations & more",
         {{6, 0.5, "4x4"}, {11, 0.2, "8x4"}, {kNaN, kNaN, "16x4"}, {45, 0.03, "32x4"}}},
        {"xpbd double, 1 iteration on the processor of this machine", {{21, 0.41, "4x1"}, {42, 0.1, "8x1"},
                                     {81, 0.025, "16x1"}, {330, 0.0019, "64x1"}, {660, 0.0006, "128x1"}}},
    };
    plot.caption = {"Reference R3 (explicit, fp64), own error 3e-6; mass-weighted over moving vertices.",
                    "20 repetitions, median."};
    plot.gaps = {"xpbd float 256x1: the run diverged at step 12 <limit 1e6 m/s>"};
    return plot;
}

/// A small checker: tags nest, attributes are quoted, no stray < or &. Empty when well formed.
std::string malformed(const std::string& xml)
{
    std::vector<std::string> open;
    for (std::size_t i = 0; i < xml.size(); ++i)
    {
        if (xml[i] == '&')
        {
            const std::string name = xml.substr(i + 1, xml.find(';', i) - i - 1);
            if (name != "amp" && name != "lt" && name != "gt" && name != "quot")
                return "entity " + name;
        }
        if (xml[i] != '<')
            continue;
        const std::size_t end = xml.find('>', i);
        if (end == std::string::npos)
            return "an open tag at the end";
        const std::string tag = xml.substr(i + 1, end - i - 1);
        i = end;
        if (tag.find('<') != std::string::npos || std::count(tag.begin(), tag.end(), '"') % 2 != 0)
            return "bad tag " + tag;
        if (tag[0] == '?' || tag.back() == '/')
            continue;
        if (tag[0] != '/')
            open.push_back(tag.substr(0, tag.find(' ')));
        else if (open.empty() || open.back() != tag.substr(1))
            return "closing " + tag;
        else
            open.pop_back();
    }
    return open.empty() ? "" : "never closed: " + open.back();
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

constexpr const char* kHalo = "fill=\"#fff\" stroke=\"#fff\"";

struct Place
{
    double x = 0, y = 0; ///< left end and foot of words 10 high
};
/// Where labels of these words stand, or their halos.
std::vector<Place> places(const std::string& text, const std::string& words, bool halos = false)
{
    std::vector<Place> out;
    const std::string end = ">" + words + "</text>";
    for (std::size_t at = 0; (at = text.find(end, at)) != std::string::npos; ++at)
    {
        const std::string tag = text.substr(text.rfind("<text", at), at - text.rfind("<text", at));
        const auto value = [&](const char* key) {
            return std::stod(tag.substr(tag.find(key) + std::string(key).size()));
        };
        if ((tag.find(kHalo) != std::string::npos) == halos)
            out.push_back({value(" x=\""), value(" y=\"")});
    }
    return out;
}

} // namespace

TEST_CASE("a plot is well-formed XML whatever its words hold", "[svg]")
{
    Plot plot = sample();
    plot.title = "<a & \"b\"> \x01";
    plot.series[0].name = "x < y";
    CHECK(malformed(svg(plot)) == "");
    CHECK(malformed(svg(Plot{})) == "");
    CHECK(malformed("<a><b></a></b>") != "");
    CHECK(svg(plot).find('\x01') == std::string::npos);
}

TEST_CASE("the front holds exactly the points that nothing beats in both", "[svg]")
{
    const std::vector<PlotSeries> series = {{"a", {{1, 8, ""}, {2, 4, ""}, {3, 5, ""}, {0, 0.1, ""}}},
                                            {"b", {{2, 6, ""}, {4, 1, ""}, {9, 1, ""}, {kNaN, 0.1, ""}}}};
    std::vector<std::pair<std::size_t, std::size_t>> found;
    for (const FrontPoint& f : pareto_front(series))
        found.emplace_back(f.series, f.point);
    CHECK(found == std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {0, 1}, {1, 1}});
    CHECK(pareto_front({}).empty());
}

TEST_CASE("what cannot be drawn breaks the line, is counted, and stands in the table beside", "[svg]")
{
    const std::string text = svg(sample());
    CHECK(text.find("Without a point: 2 entries") != std::string::npos);
    CHECK(text.find("diverged") == std::string::npos);
    const std::string table = gap_table(sample());
    CHECK(table.find("| xpbd float, 4 iterations & more, 16x4 | no finite positive value") !=
          std::string::npos);
    CHECK(table.find("| xpbd float 256x1 | the run diverged at step 12 <limit 1e6 m/s> |") !=
          std::string::npos);
    CHECK(count(table, "\n") == 4);
    CHECK(gap_table(Plot{}).empty());
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("inf") == std::string::npos);
    CHECK(count(text, "<title>") == 14);   // 15 points less one
    CHECK(count(text, "<polyline") == 4);  // one each, and the front; 32x4 stands alone
}

TEST_CASE("a point stands where its logarithm says", "[svg]")
{
    Plot plot;
    plot.series = {{"a", {{1, 1e-2, ""}, {10, 1e-1, ""}, {100, 1, ""}}}};
    // The area is 560 x 400 from (84, 56): two decades each.
    CHECK(svg(plot).find("points=\"84.00,456.00 364.00,256.00 644.00,56.00\"") != std::string::npos);
}

TEST_CASE("an outlier does not stretch the axis: it stands at its edge, with its number", "[svg]")
{
    Plot plot;
    plot.series = {{"calm", {{1, 0.5, "1x1"}, {10, 5e-2, "10x1"}, {100, 5e-3, "100x1"}}},
                   {"wild", {{0.5, 3e15, "1x1"}, {2, 2e6, "2x1"}, {20, 0.4, "20x1"}}, true}};
    CHECK(off_the_top(plot.series, 1) == Approx(5));
    const std::string all = svg(plot);
    CHECK(count(all, "off the top") == 0);
    plot.y_most = off_the_top(plot.series, 1);
    const std::string text = svg(plot);
    CHECK(malformed(text) == "");
    CHECK(count(text, "wild, 1x1: off the top, 3e+15") == 1);
    CHECK(count(text, "Off the top (above 5):") == 1);
    CHECK(count(text, "wild: 1x1 at 3e+15; 2x1 at 2e+06") == 1);
    CHECK(count(text, "<title>") == 6); // nobody is lost
    // The axis goes from 10^-3 to 1, as far as the others do: three decades hold the calm points.
    // 456 - 400 (log10(0.5) + 3) / 3
    CHECK(text.find("cy=\"96.14\"") != std::string::npos);
    CHECK(std::isinf(off_the_top({{"a", {{1, 7, ""}}}}, 1)));
}

TEST_CASE("a linear axis has round numbers, and long series have few markers", "[svg]")
{
    Plot plot;
    plot.front = false;
    plot.x_linear = true;
    plot.series = {{"long", {}}, {"short", {{0, 1, ""}, {2.5, 10, ""}}}};
    for (int k = 0; k <= 120; ++k)
        plot.series[0].points.push_back({k / 48.0, 1.0 + k, ""});
    const std::string text = svg(plot);
    CHECK(malformed(text) == "");
    CHECK(count(text, "<title>short") == 2);
    // A point every 560 / 120 pixels: from the first on one in eight stands 36 pixels off the last.
    CHECK(count(text, "<title>long") == 16);
    CHECK(count(text, ">0.5</text>") == 1);
    CHECK(count(text, ">2.5</text>") == 1);
    CHECK(count(text, ">0</text>") == 1);
    CHECK(text.find("points=\"84.00,456.00 644.00,322.67\"") != std::string::npos); // 0 to 2.5; a third up
}

TEST_CASE("labels do not stand on each other", "[svg]")
{
    Plot plot;
    plot.series.push_back({"first", {{100, 0.9, "begin"}}});
    for (int k = 0; k < 40; ++k)
        plot.series.push_back({"s", {{1000 + 0.1 * k, 0.1 - 0.0001 * k, "label " + std::to_string(k)}}});
    plot.series.push_back({"far", {{1e5, 2e-4, "alone"}}});
    const std::string text = svg(plot);
    CHECK(places(text, "alone").size() == 1);
    std::vector<Place> at;
    for (int k = 0; k < 40; ++k)
        for (const Place& place : places(text, "label " + std::to_string(k)))
            at.push_back(place);
    CHECK(at.size() >= 2);  // on both sides
    CHECK(at.size() <= 14); // as many places as are tried
    for (std::size_t a = 0; a < at.size(); ++a)
        for (std::size_t b = a + 1; b < at.size(); ++b)
        {
            INFO(at[a].x << "," << at[a].y << " and " << at[b].x << "," << at[b].y);
            CHECK((std::abs(at[a].x - at[b].x) >= 30 || std::abs(at[a].y - at[b].y) >= 10));
        }
}

TEST_CASE("the halo of a label is an element of its own before all labels", "[svg]")
{
    const std::string text = svg(sample());
    CHECK(count(text, "paint-order") == 0); // not known to Cairo, which would cover the letters
    std::size_t labels = 0;
    for (const char* words : {"4x1", "8x1", "16x1", "32x1", "64x1", "128x1"})
    {
        INFO(words);
        const std::vector<Place> label = places(text, words), halo = places(text, words, true);
        REQUIRE(label.size() == halo.size());
        for (std::size_t k = 0; k < label.size(); ++k)
            CHECK((label[k].x == halo[k].x && label[k].y == halo[k].y));
        labels += label.size();
    }
    CHECK(labels >= 4);
    CHECK(count(text, kHalo) == labels);
    CHECK(text.rfind(kHalo) < text.find("font-size=\"10.00\" text-anchor=\"start\" fill=\"#111\""));
}

TEST_CASE("labels keep off the marks of other series", "[svg]")
{
    Plot plot;
    plot.front = false;
    plot.series = {{"a", {{1, 1e-2, ""}, {100, 1e-4, ""}}, false, "a note"}};
    const auto note = [&plot] {
        const std::vector<Place> at = places(svg(plot), "a note");
        return at.empty() ? std::pair(-1.0, -1.0) : std::pair(at[0].x, at[0].y);
    };
    const auto alone = note();
    // A row of marks where the note stood.
    for (double x = 20; x < 100; x *= 1.05)
        plot.series.push_back({"b", {{x, 1.03e-4, ""}, {x, 1.2e-4, ""}}});
    CHECK(note() != alone);
}

TEST_CASE("the words of a floor stand along its line where no curve and no mark is", "[svg]")
{
    Plot plot;
    plot.front = false;
    plot.series = {{"a", {{1, 1, ""}, {1000, 1e-4, ""}}}};
    plot.floors = {{1e-2, "rest test"}};
    const auto words = [&plot] {
        const std::vector<Place> at = places(svg(plot), "rest test");
        REQUIRE(at.size() == 1);
        return at[0];
    };
    // The area is 560 x 400 from (84, 56), four decades high: the floor stands at 256.
    const Place free = words();
    CHECK(free.x > 560);
    CHECK(free.y == Approx(253));
    plot.series.push_back({"on it", {{100, 1.1e-2, ""}, {1000, 1.1e-2, ""}}}); // a curve of two marks
    const Place below = words();
    CHECK(below.x == free.x);
    CHECK(below.y == Approx(267));
    plot.series.push_back({"under it", {{100, 9e-3, ""}, {1000, 9e-3, ""}}});
    const Place left = words();
    CHECK(left.x + 9 * 5 < 84 + 560 * 2 / 3.0); // left of both, which begin at two thirds
    for (int k = 0; k < 30; ++k) // nowhere is a place: the words are there nevertheless
    {
        const double x = std::pow(10.0, 0.1 * k);
        plot.series.push_back({"wall", {{x, 1, ""}, {x, 1e-4, ""}}});
    }
    words();
}

TEST_CASE("a floor at a decade is seen: its line is drawn after the grid", "[svg]")
{
    Plot plot;
    plot.series = {{"a", {{1, 1, ""}, {10, 1e-4, ""}}}};
    plot.floors = {{1e-2, "rest test"}};
    const std::string line = "<line x1=\"84.00\" y1=\"256.00\" x2=\"644.00\" y2=\"256.00\" ";
    const std::string text = svg(plot);
    CHECK(count(text, line) == 2);
    CHECK(text.find(line + "stroke=\"#777\"") == text.rfind(line));
}

TEST_CASE("no two series look alike, and a style is the same in every plot", "[svg]")
{
    // What a legend shows of each of many series, without their places.
    const auto looks = [](int styles) {
        Plot plot;
        plot.front = false;
        for (int i = 0; i < 20; ++i)
            plot.series.push_back(
                {"s", {{1, 1, ""}}, false, "", styles ? i % styles : -1, styles ? i / styles : 0});
        std::set<std::string> out;
        for (std::size_t i = 0; i < plot.series.size(); ++i)
        {
            Plot one = plot;
            for (std::size_t k = 0; k < plot.series.size(); ++k)
                if (k != i)
                    one.series[k].points.clear();
            const std::string text = svg(one); // the only <title> is that of the point, on the same place
            const std::size_t at = text.find("<title>");
            out.insert(text.substr(at, text.find("</g>", at) - at));
        }
        return out;
    };
    CHECK(looks(0).size() == 20); // by their places
    CHECK(looks(7).size() == 20); // variants of seven styles
    CHECK(looks(2).size() == 20); // ten variants of one
    Plot first, second;
    first.series = {{"vbd", {{1, 1, ""}}, false, "", 6}};
    second.series = {{"pbd", {{1, 1, ""}}, false, "", 4}, {"vbd", {{1, 1, ""}}, false, "", 6}};
    const auto look = [](const Plot& plot) {
        const std::string text = svg(plot);
        const std::size_t at = text.find("<title>vbd");
        return text.substr(at, text.find("</g>", at) - at);
    };
    CHECK(look(first) == look(second));
}

TEST_CASE("below a floor the plot is shaded, with a line and its words; far below the points it is not drawn",
          "[svg]")
{
    Plot plot;
    plot.series = {{"a", {{1, 1e-2, ""}, {10, 1e-4, ""}, {100, 2e-5, ""}}}};
    plot.floors = {{1e-4, "rest test"}, {1e-16, "one rounding of double"}};
    const std::string text = svg(plot);
    CHECK(malformed(text) == "");
    CHECK(count(text, "fill-opacity=\"0.12\"") == 1);
    CHECK(places(text, "rest test").size() == 1);
    plot.floors[0].of_all = false; // a line says it
    const std::string some = svg(plot);
    CHECK(count(some, "fill-opacity=\"0.12\"") == 0);
    CHECK(places(some, "rest test").size() == 1);
    CHECK(text.find("double") == std::string::npos);
}

TEST_CASE("a spread stands as a bar across its point", "[svg]")
{
    Plot plot;
    plot.front = false;
    plot.series = {{"a", {{1, 1e-2, ""}, {10, 1e-1, "", 0, 5, 20}, {100, 1, ""}}}};
    // Two decades on 560 pixels from 84: 10 is at 364, 5 at 364 - 280 log10(2).
    CHECK(svg(plot).find("<line x1=\"279.71\" y1=\"256.00\" x2=\"448.29\" y2=\"256.00\"") !=
          std::string::npos);
}

TEST_CASE("the same plot is the same text in every locale", "[svg]")
{
    const std::string before = svg(sample());
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"})
        if (std::setlocale(LC_ALL, name))
            CHECK(svg(sample()) == before);
    std::setlocale(LC_ALL, "C");
}

TEST_CASE("a plot file is complete or absent", "[svg]")
{
    const auto folder = std::filesystem::temp_directory_path() / "taut_svg_test";
    std::filesystem::create_directories(folder);
    write_svg(folder / "plot.svg", sample());
    std::ifstream in(folder / "plot.svg", std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    CHECK(text.str() == svg(sample()));
    CHECK(!std::filesystem::exists(folder / "plot.svg.part"));
    CHECK_THROWS_AS(write_svg(folder / "missing" / "plot.svg", sample()), Error);
    std::filesystem::remove_all(folder);
}
