// taut-kernelc: the build's kernel compiler.
//   taut-kernelc KERNEL.comp INCLUDE_ROOT OUT_DIR [ELEMENT]
//       writes <stem>.hpp, <stem>.cpp, <stem>.native.cpp, and <stem>.lanes.cpp if the kernel has a line
//       "//! lanes". With ELEMENT ("elements/spring.glsl" below INCLUDE_ROOT, or a path from the root of the
//       file system; or a shape of colliders) the kernel is compiled for it, and <stem> is <stem>_<element>
//   taut-kernelc --includes INCLUDE_ROOT OUT_FILE
//       embeds kernels/shared/*, kernels/elements/* and kernels/colliders/* as text

#include "taut/runtime/compiler/bindings_text.hpp"
#include "taut/runtime/compiler/variants.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

// The tool resolves includes from the folder, never from an embedded copy.
std::string_view taut::builtin_include(std::string_view) { return {}; }

namespace {

std::string read_text(const fs::path& path)
{
    std::ifstream file(path);
    if (!file)
        throw taut::Error(taut::ErrorCode::io, "cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Writes only when the text differs: an unchanged header rebuilds nothing where the build tool looks at what
/// a command really wrote (Ninja). For others cmake/kernels.cmake touches the outputs.
void write_text(const fs::path& path, const std::string& text)
{
    std::ifstream old(path);
    if (old && std::string(std::istreambuf_iterator<char>(old), {}) == text)
        return;
    std::ofstream file(path);
    file << text;
    file.close(); // what was buffered fails here, not in the destructor
    if (!file)
        throw taut::Error(taut::ErrorCode::io, "cannot write " + path.string());
}

std::vector<std::string> files_of(const fs::path& root, const std::string& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(root / folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string identifier(const taut::CompiledKernel& k)
{
    return (k.variant.empty() ? "base" : k.variant) +
           (k.info.precision == taut::Precision::float64 ? "_float64" : "_float32");
}

std::string words(const std::vector<std::uint32_t>& data)
{
    std::ostringstream out;
    for (std::size_t i = 0; i < data.size(); ++i)
        out << "0x" << std::hex << data[i] << (i % 12 == 11 ? ",\n" : ",");
    return out.str();
}

/// A string literal in pieces: compilers limit the length of one.
std::string literal(const std::string& text)
{
    std::istringstream lines(text);
    std::string line, out;
    while (std::getline(lines, line))
    {
        out += "    \"";
        for (const char c : line)
            out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
        out += "\\n\"\n";
    }
    return out.empty() ? "\"\"" : out;
}

using Kernels = std::vector<std::shared_ptr<const taut::CompiledKernel>>;

std::string header_text(const std::string& stem, const Kernels& kernels)
{
    std::ostringstream out;
    out << "#pragma once\n// Generated from kernels/**/" << stem << ".comp. Do not edit.\n\n"
        << "#include \"taut/runtime/base/kernel_info.hpp\"\n\n#include <array>\n"
           "#include <cstddef>\n#include <cstdint>\n#include <span>\n#include <string_view>\n"
           "#include <utility>\n\n"
        << "namespace taut::kernels::" << stem << " {\n\n";
    const auto& params = kernels.front()->params;
    if (!params.empty())
    {
        out << "/// Fixed per dispatch; the same block as in the kernel.\nstruct Params\n{\n";
        for (const auto& p : params)
            out << "    "
                << (p.type == "uint"  ? "std::uint32_t"
                    : p.type == "int" ? "std::int32_t"
                                      : "float")
                << " " << p.name << " = 0;\n";
        out << "};\nstatic_assert(sizeof(Params) == " << kernels.front()->info.param_bytes << ");\n";
        for (const auto& p : params)
            out << "static_assert(offsetof(Params, " << p.name << ") == " << p.offset << ");\n";
    }
    out << "\n/// Throws Error{unsupported} when there is no such variant.\n"
        << "const KernelInfo& info(std::string_view variant = {}, "
           "Precision precision = Precision::float32);\n"
        << "/// Every variant in every precision.\nstd::span<const KernelInfo> all();\n\n"
        << taut::bindings_text(stem, kernels) << "\n} // namespace taut::kernels::" << stem << "\n";
    return out.str();
}

/// `own`: the text of the kernel's element; what it declares itself is in no header of the host.
void table_text(std::ostringstream& out, const taut::CompiledKernel& k, const std::string& own)
{
    const std::string id = identifier(k);
    out << "const std::uint32_t vulkan_" << id << "[] = {" << words(k.spirv_vulkan) << "};\n"
        << "const std::uint32_t opengl_" << id << "[] = {" << words(k.spirv_opengl) << "};\n"
        << "const char glsl_" << id << "[] =\n"
        << literal(k.glsl) << ";\n";
    out << "constinit const BindingInfo bindings_" << id << "[] = {\n";
    for (const auto& b : k.bindings)
        out << "    {\"" << b.name << "\", " << b.slot << ", static_cast<Access>("
            << static_cast<int>(b.access) << "), " << b.stride << "},\n";
    out << "};\n";
    if (!k.params.empty())
    {
        out << "constinit const ParamInfo params_" << id << "[] = {\n";
        for (const auto& p : k.params)
            out << "    {\"" << p.name << "\", \"" << p.type << "\", " << p.offset << "},\n";
        out << "};\n";
    }
    const char* real = k.info.precision == taut::Precision::float64 ? "double" : "float";
    for (const auto& m : k.layouts)
        if (own.find("LAYOUT_STRUCT(" + m.record + ")") == std::string::npos)
            out << "static_assert(offsetof(layout::" << m.record << "<" << real << ">, " << m.name
                << ") == " << m.offset << " && sizeof(layout::" << m.record << "<" << real
                << ">) == " << m.stride << ");\n";
}

std::string source_text(const std::string& stem, const Kernels& kernels, const std::string& own)
{
    std::ostringstream out;
    out << "// Generated. Do not edit.\n#include \"taut/kernels/" << stem << ".hpp\"\n"
        << "#define TAUT_HOST\n#include \"taut/kernels/shared/layouts.h\"\n"
        << "#include \"taut/runtime/base/error.hpp\"\n#include <string>\n\nnamespace taut::kernels::" << stem
        << " {\n";
    for (const auto& k : kernels)
        out << "void native_" << identifier(*k)
            << "(const void*, void* const*, std::uint32_t, std::uint32_t);\n";
    out << "namespace {\n";
    for (const auto& k : kernels)
        table_text(out, *k, own);
    // Constants, said with their lengths: a table that is made when the program starts, or whose texts the
    // compiler counts letter by letter, takes most of what these files take to compile.
    out << "constinit const KernelInfo table[] = {\n";
    for (const auto& k : kernels)
    {
        const std::string id = identifier(*k);
        out << "    {\"" << stem << "\", \"" << k->variant << "\", Precision::float"
            << (k->info.precision == taut::Precision::float64 ? "64" : "32") << ", "
            << (k->info.group_kernel ? "true" : "false") << ", " << k->info.group_size << ", "
            << k->info.shared_bytes << ", " << k->info.param_bytes << ",\n     bindings_" << id << ", "
            << (k->params.empty() ? "{}" : "params_" + id) << ", vulkan_" << id << ", opengl_" << id
            << ", {glsl_" << id << ", sizeof glsl_" << id << " - 1}, native_" << id << "},\n";
    }
    out << "};\n} // namespace\n\nconst KernelInfo& info(std::string_view variant, Precision precision)\n{\n"
        << "    for (const KernelInfo& kernel : table)\n"
        << "        if (kernel.variant == variant && kernel.precision == precision)\n"
           "            return kernel;\n"
        << "    throw Error(ErrorCode::unsupported, \"kernel " << stem
        << " has no variant \\\"\" + std::string(variant) + \"\\\"\");\n}\n\n"
        << "std::span<const KernelInfo> all() { return table; }\n\n} // namespace taut::kernels::" << stem
        << "\n";
    return out.str();
}

/// What differs between the two native forms of a kernel: one element at a time, and several.
struct NativeForm
{
    const char* prefix; ///< of its namespace: the linker must never take one form for the other
    const char* room;   ///< where its types live
    const char* types;
    const char* members; ///< of struct Kernel, besides the kernel's own
};

constexpr NativeForm kScalar = {"", "taut::native",
                                "using rvec3 = glm::vec<3, real>;\nusing rvec4 = glm::vec<4, real>;\n", ""};
constexpr NativeForm kLanes = {"lanes_", "taut::lanes",
                               "using rvec3 = taut::lanes::Vec3;\nusing rvec4 = taut::lanes::Vec4;\n"
                               "using rbool = taut::lanes::Bool;\n",
                               "std::uint32_t taut_active = 0xFF;\n"};

/// Whether a kernel asks to run several elements at a time.
bool has_lanes(const std::string& text) { return text.find("\n//! lanes\n") != std::string::npos; }

std::string native_head(const std::string& stem, const std::string& portable)
{
    return "// Generated. Do not edit.\n#include \"taut/runtime/cpu/" + portable +
           "\"\n#include \"taut/kernels/" + stem + ".hpp\"\n\nnamespace taut::kernels::" + stem + " {\n";
}

constexpr const char* kRange = "(const void* p, void* const* b, std::uint32_t begin, std::uint32_t end)";

using Macros = std::vector<std::pair<std::string, std::string>>;

/// Those of the variant and, for a kernel of an element, of that.
Macros macros_of(const taut::KernelVariant& variant, const taut::ElementFile& element)
{
    Macros out = variant.defines;
    if (element.path.empty())
        return out;
    for (const auto& define : taut::element_defines(element))
        out.push_back(define);
    out.emplace_back(taut::element_include(element), '"' + element.path + '"');
    return out;
}

/// The names that a text defines itself. Several kernels may be compiled at once, and none sees another's.
std::vector<std::string> defined_in(const std::string& text)
{
    std::istringstream lines(text);
    std::vector<std::string> out;
    for (std::string line; std::getline(lines, line);)
    {
        std::istringstream words(line);
        std::string first, name;
        words >> first >> name;
        if (first == "#define")
            out.push_back(name.substr(0, name.find('(')));
    }
    return out;
}

struct NativeSource
{
    std::string path; ///< below the include root, so that no machine's is written
    std::vector<std::string> shared; ///< files of the folder
    std::vector<std::string> own;    ///< macros that it defines, and what it may include
};

NativeSource native_source(const std::string& path, const std::string& text, const fs::path& root,
                           const std::string& element)
{
    NativeSource out = {path, files_of(root, "shared"), defined_in(text + '\n' + element)};
    std::set<std::string> names(out.own.begin(), out.own.end());
    for (const std::string& file : out.shared)
        if (file != "portable.glsl" && file != "layouts.h") // portable.hpp has words of theirs, for all
            for (const std::string& name : defined_in(read_text(root / "shared" / file)))
                names.insert(name);
    out.own.assign(names.begin(), names.end());
    return out;
}

/// The kernel as `struct Kernel` in a namespace of its own.
void native_kernel(std::ostringstream& out, const NativeSource& source, const taut::CompiledKernel& k,
                   const Macros& macros, const NativeForm& form)
{
    const std::string id = form.prefix + identifier(k);
    for (const std::string& file : source.shared)
    {
        std::string guard = "TAUT_SHARED_" + file;
        std::transform(guard.begin(), guard.end(), guard.begin(), [](unsigned char c) {
            return std::isalnum(c) ? static_cast<char>(std::toupper(c)) : '_';
        });
        out << "#undef " << guard << "\n";
    }
    for (const auto& [name, value] : macros)
        out << "#define " << name << " " << value << "\n";
    const bool is_double = k.info.precision == taut::Precision::float64;
    const char* real = &form == &kLanes ? "taut::lanes::Real" : is_double ? "double" : "float";
    out << "#define TAUT_REAL_DOUBLE " << (is_double ? 1 : 0) << "\nnamespace " << id
        << " {\nusing namespace " << form.room << ";\nusing real = " << real << ";\n"
        << form.types << "struct Kernel\n{\n"
        << form.members << "#include \"" << source.path
        << "\"\n    void bind([[maybe_unused]] const void* params, void* const* buffers)\n    {\n";
    if (!k.params.empty())
        out << "        const Params& p = *static_cast<const Params*>(params);\n";
    for (const auto& p : k.params)
        out << "        " << p.name << " = p." << p.name << ";\n";
    for (const auto& b : k.bindings)
        out << "        " << form.room << "::attach(" << b.name << ", buffers[" << b.slot << "]);\n";
    out << "    }\n};\n} // namespace " << id << "\n#undef TAUT_REAL_DOUBLE\n";
    for (const auto& define : macros)
        out << "#undef " << define.first << "\n";
    for (const std::string& name : source.own)
        out << "#undef " << name << "\n";
}

const char* runner(const taut::CompiledKernel& k)
{
    return k.info.group_kernel ? "run_groups" : "run_elements";
}

/// The function that the table names. With lanes it leaves what it can to them.
void native_entry(std::ostringstream& out, const taut::CompiledKernel& k, bool lanes)
{
    const std::string id = identifier(k);
    if (lanes)
        out << "#if TAUT_LANES\nstd::uint32_t lanes_run_" << id << kRange << ";\n#endif\n";
    out << "void native_" << id << kRange << "\n{\n";
    if (lanes)
        out << "#if TAUT_LANES\n    if (taut::native::has_lanes())\n        begin = lanes_run_" << id
            << "(p, b, begin, end);\n    if (begin == end)\n        return;\n#endif\n";
    out << "    taut::native::" << runner(k) << "<" << id << "::Kernel>(p, b, begin, end);\n}\n\n";
}

/// Gives the first element back that is left to do.
void lanes_entry(std::ostringstream& out, const taut::CompiledKernel& k)
{
    const std::string id = identifier(k);
    out << "std::uint32_t lanes_run_" << id << kRange << "\n{\n    return taut::lanes::" << runner(k)
        << "<lanes_" << id << "::Kernel>(p, b, begin, end);\n}\n\n";
}

void compile(const fs::path& kernel_path, const fs::path& root, const fs::path& out_dir,
             const taut::ElementFile& element)
{
    const std::string stem =
        kernel_path.stem().string() + (element.path.empty() ? "" : "_" + element.stem);
    const std::string text = read_text(kernel_path);
    const bool uses_real = text.find("real") != std::string::npos || text.find("rvec") != std::string::npos ||
                           text.find("layouts.h") != std::string::npos;
    const std::string own = element.path.empty() ? std::string() : read_text(root / element.path);
    const NativeSource source =
        native_source(fs::relative(kernel_path, root).generic_string(), text, root, own);
    Kernels kernels;
    const bool lanes = has_lanes(text) && !element.has_values;
    std::ostringstream native, several;
    native << native_head(stem, "portable.hpp");
    several << native_head(stem, "lane_portable.hpp");
    for (const auto& variant : taut::kernel_variants(stem, text, element))
        for (const auto precision : {taut::Precision::float32, taut::Precision::float64})
        {
            if (precision == taut::Precision::float64 && !uses_real)
                continue;
            const auto kernel = taut::compile_kernel({stem, text, root, variant, precision, element});
            const Macros macros = macros_of(variant, element);
            native_kernel(native, source, *kernel, macros, kScalar);
            const bool has_form = lanes && precision == taut::Precision::float32;
            native_entry(native, *kernel, has_form);
            if (has_form)
            {
                native_kernel(several, source, *kernel, macros, kLanes);
                lanes_entry(several, *kernel);
            }
            kernels.push_back(kernel);
        }
    for (std::ostringstream* out : {&native, &several})
        *out << "} // namespace taut::kernels::" << stem << "\n";
    fs::create_directories(out_dir);
    write_text(out_dir / (stem + ".hpp"), header_text(stem, kernels));
    write_text(out_dir / (stem + ".cpp"), source_text(stem, kernels, own));
    write_text(out_dir / (stem + ".native.cpp"), native.str());
    if (lanes)
        write_text(out_dir / (stem + ".lanes.cpp"), several.str());
}

void embed_includes(const fs::path& root, const fs::path& out_file)
{
    std::ostringstream out;
    out << "// Generated. Do not edit.\n#include \"taut/runtime/compiler/compiler.hpp\"\n\n"
           "namespace taut {\n\n"
        << "std::string_view builtin_include(std::string_view path)\n{\n";
    for (const std::string folder : {"shared", "elements", "colliders"})
        for (const std::string& name : files_of(root, folder))
            out << "    if (path == \"" << folder << "/" << name << "\")\n        return\n"
                << literal(read_text(root / folder / name)) << ";\n";
    out << "    return {};\n}\n\n} // namespace taut\n";
    write_text(out_file, out.str());
}

} // namespace

int main(int argc, char** argv)
try
{
    if (argc == 4 && std::string_view(argv[1]) == "--includes")
        embed_includes(argv[2], argv[3]);
    else if (argc == 4)
        compile(argv[1], argv[2], argv[3], {});
    else if (argc == 5)
        compile(argv[1], argv[2], argv[3],
                taut::element_file(argv[4], read_text(fs::path(argv[2]) / argv[4])));
    else
        return std::fprintf(stderr, "usage: taut-kernelc KERNEL.comp INCLUDE_ROOT OUT_DIR [ELEMENT]\n"), 2;
    return 0;
}
catch (const std::exception& error)
{
    std::cerr << error.what() << "\n";
    return 1;
}
