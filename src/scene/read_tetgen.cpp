// TetGen: vertices in a .node file, tetrahedra in the .ele file beside it. Both may be numbered from
// anywhere.

#include "taut/scene/solid_builder.hpp"
#include "taut/scene/words.hpp"

namespace taut::scene_file {
namespace {

/// The first line: a count of lines and what each of them holds.
struct TetgenHead
{
    std::size_t lines = 0, second = 0, third = 0;
};

/// `numbers`: that each line has at least.
TetgenHead read_head(Words& words, std::string_view what, std::size_t numbers)
{
    if (!words.next_line())
        words.fail("the file is empty; its first line must announce " + std::string(what));
    const std::int64_t lines = words.integer("number of " + std::string(what));
    if (lines < 0 || static_cast<std::uint64_t>(lines) > (words.left() + 1) / (2 * numbers))
        words.fail("the file announces " + std::to_string(lines) + " " + std::string(what) +
                   ", more than it holds");
    TetgenHead head;
    head.lines = static_cast<std::size_t>(lines);
    for (std::size_t* value : {&head.second, &head.third})
        if (const std::string_view word = words.word(); !word.empty())
        {
            const std::int64_t number = words.to_integer(word, "a number of the first line");
            if (number < 0 || number > 1000)
                words.fail("the first line has the number " + std::to_string(number) +
                           "; it must be from 0 to 1000");
            *value = static_cast<std::size_t>(number);
        }
    return head;
}

void next_line(Words& words, std::size_t at, std::size_t lines, std::string_view what)
{
    if (!words.next_line())
        words.fail("the file ends after " + std::to_string(at) + " " + std::string(what) + "; it announces " +
                   std::to_string(lines));
}

void no_more(Words& words, std::string_view what)
{
    if (words.next_line())
        words.fail("there is " + quoted(words.word()) + " after the last of the announced " +
                   std::string(what));
}

void read_nodes(Words words, SolidBuilder& out)
{
    const TetgenHead head = read_head(words, "vertices", 4);
    if (head.second != 3)
        words.fail("vertices have " + std::to_string(head.second) + " coordinates; they must have 3");
    for (std::size_t v = 0; v < head.lines; ++v)
    {
        next_line(words, v, head.lines, "vertices");
        const std::int64_t number = words.integer("number of a vertex");
        out.add_vertex(number, words.position()); // attributes and the boundary mark are passed over
    }
    no_more(words, "vertices");
    if (const std::string wrong = out.close_vertices(); !wrong.empty())
        words.fail(wrong);
}

void read_elements(Words words, SolidBuilder& out)
{
    const TetgenHead head = read_head(words, "tetrahedra", 5);
    if (head.second != 4)
        words.fail("tetrahedra have " + std::to_string(head.second) + " vertices; they must have 4" +
                   (head.second == 10 ? " (run TetGen without -o2)" : ""));
    for (std::size_t t = 0; t < head.lines; ++t)
    {
        next_line(words, t, head.lines, "tetrahedra");
        const std::int64_t number = words.integer("number of a tetrahedron");
        std::array<std::int64_t, 4> corners{};
        for (std::int64_t& corner : corners)
            corner = words.integer("corner of a tetrahedron");
        if (const std::string wrong = out.add_tetrahedron(number, corners); !wrong.empty())
            words.fail(wrong);
    }
    no_more(words, "tetrahedra");
}

} // namespace

RawSolid read_tetgen(const NamedText& node, const NamedText& ele)
{
    SolidBuilder out;
    read_nodes(Words(node.text, node.file), out);
    read_elements(Words(ele.text, ele.file), out);
    return out.take();
}

} // namespace taut::scene_file
