#pragma once
// How rows and tables of descriptor.hpp are written down: key<&Member>(name, sentence).unit(...).above(...).
// Internal to the files that hold tables.

#include "taut/scene/descriptor.hpp"

#include <optional>
#include <utility>

namespace taut::scene_file {

namespace detail {

template <class F>
struct Function;
template <class O, class R>
struct Function<R (*)(O&)>
{
    using Owner = std::remove_const_t<O>;
};
template <class O, class R, class A>
struct Function<R (*)(const A&, O&)>
{
    using Owner = std::remove_const_t<O>;
};
template <class O>
struct Function<void (*)(const O&, const Checker&)>
{
    using Owner = O;
};

template <class T>
struct Member;
template <class O, class V>
struct Member<V O::*>
{
    using Owner = O;
    using Value = V;
};
template <auto M>
using OwnerOf = typename Member<decltype(M)>::Owner;
template <auto M>
using ValueOf = typename Member<decltype(M)>::Value;

template <class T>
constexpr Kind kind_of()
{
    if constexpr (std::is_same_v<T, double>)
        return Kind::number;
    else if constexpr (std::is_same_v<T, std::uint32_t>)
        return Kind::count;
    else if constexpr (std::is_same_v<T, std::optional<double>>)
        return Kind::maybe_number;
    else if constexpr (std::is_same_v<T, std::optional<std::uint32_t>>)
        return Kind::maybe_count;
    else if constexpr (std::is_same_v<T, int>)
        return Kind::version;
    else if constexpr (std::is_same_v<T, bool>)
        return Kind::boolean;
    else if constexpr (std::is_same_v<T, std::string>)
        return Kind::text;
    else if constexpr (Option<T>)
        return Kind::option;
    else if constexpr (std::is_same_v<T, std::filesystem::path>)
        return Kind::file;
    else if constexpr (std::is_same_v<T, glm::dvec3>)
        return Kind::vector;
    else if constexpr (std::is_same_v<T, glm::dvec2>)
        return Kind::number_pair;
    else if constexpr (std::is_same_v<T, glm::uvec2>)
        return Kind::count_pair;
    else if constexpr (std::is_same_v<T, glm::uvec3>)
        return Kind::count_triple;
    else if constexpr (std::is_same_v<T, std::vector<std::uint32_t>>)
        return Kind::counts;
    else if constexpr (std::is_same_v<T, std::vector<double>>)
        return Kind::numbers;
    else if constexpr (std::is_same_v<T, std::vector<glm::dvec3>>)
        return Kind::vectors;
    else
    {
        static_assert(std::is_same_v<T, std::vector<std::string>>, "no key reads this type");
        return Kind::texts;
    }
}

constexpr bool counts(Kind kind)
{
    return kind == Kind::count || kind == Kind::maybe_count || kind == Kind::count_pair ||
           kind == Kind::count_triple || kind == Kind::counts || kind == Kind::version;
}

template <class Owner>
constexpr Key row(std::string_view name, std::string_view what, Kind kind)
{
    Key key;
    key.name = name;
    key.what = what;
    key.kind = kind;
    key.owner = &kTypeTag<Owner>;
    if (counts(kind))
        key.limits = {0, kMaxCount};
    return key;
}

/// The member of a member (of a member ...).
template <auto First, auto... More>
auto& reach(OwnerOf<First>& object)
{
    if constexpr (sizeof...(More) == 0)
        return object.*First;
    else
        return reach<More...>(object.*First);
}

} // namespace detail

/// A row whose value is a member: key<&Material::density>("density", "mass of an area"). Several members name
/// one within another.
template <auto First, auto... More>
constexpr Key key(std::string_view name, std::string_view what)
{
    using Owner = detail::OwnerOf<First>;
    using Value = std::remove_reference_t<decltype(detail::reach<First, More...>(std::declval<Owner&>()))>;
    Key out = detail::row<Owner>(name, what, detail::kind_of<Value>());
    out.at = [](void* object) -> void* {
        return &detail::reach<First, More...>(*static_cast<Owner*>(object));
    };
    if constexpr (Option<Value>)
    {
        out.word_sets[0].words = words_of<Value>();
        out.option.get = [](const void* member) {
            return static_cast<std::size_t>(*static_cast<const Value*>(member));
        };
        out.option.set = [](void* member, std::size_t place) {
            *static_cast<Value*>(member) = static_cast<Value>(place);
        };
    }
    return out;
}

template <class Object>
struct TableOf;

/// A row whose value is an object with keys of its own, kept in the member.
template <auto M>
constexpr Key object(std::string_view name, std::string_view what, const TableOf<detail::ValueOf<M>>& table)
{
    using Owner = detail::OwnerOf<M>;
    Key out = detail::row<Owner>(name, what, Kind::object);
    out.at = [](void* object) -> void* { return &(static_cast<Owner*>(object)->*M); };
    out.table = &table;
    return out;
}

/// The same, kept in the struct itself, as the parts of a collider are.
template <class Owner>
constexpr Key object(std::string_view name, std::string_view what, const TableOf<Owner>& table)
{
    Key out = detail::row<Owner>(name, what, Kind::object);
    out.at = [](void* object) { return object; };
    out.table = &table;
    return out;
}

/// A row whose value is a list of objects, kept in the member.
template <auto M>
constexpr Key list(std::string_view name, std::string_view what,
                   const TableOf<typename detail::ValueOf<M>::value_type>& table)
{
    using Owner = detail::OwnerOf<M>;
    using List = detail::ValueOf<M>;
    Key out = detail::row<Owner>(name, what, Kind::objects);
    out.at = [](void* object) -> void* { return &(static_cast<Owner*>(object)->*M); };
    out.table = &table;
    out.access.append = [](void* all) -> void* { return &static_cast<List*>(all)->emplace_back(); };
    out.access.size = [](const void* all) { return static_cast<const List*>(all)->size(); };
    out.access.element = [](const void* all, std::size_t i) -> const void* {
        return &(*static_cast<const List*>(all))[i];
    };
    return out;
}

/// A row whose text is read and forgotten.
template <class Owner>
constexpr Key ignored(std::string_view name, std::string_view what)
{
    return detail::row<Owner>(name, what, Kind::ignored);
}

/// The table of a struct. A row of another struct in it is an error of compilation.
template <class Object>
struct TableOf : Table
{
    constexpr TableOf(std::string_view name_, std::span<const Key> keys_)
    {
        name = name_;
        keys = keys_;
        owner = &kTypeTag<Object>;
        make = []() -> std::shared_ptr<void> { return std::make_shared<Object>(); };
        for (const Key& key : keys_)
            if (key.owner != owner)
                throw "a row in the table of another struct";
    }

    constexpr TableOf choosing(Choice which) const
    {
        TableOf out = *this;
        out.choice = which;
        return out;
    }
    constexpr TableOf strange(std::span<const Stranger> names) const
    {
        TableOf out = *this;
        out.strangers = names;
        return out;
    }
    /// F: void(Object&)
    template <auto F>
    constexpr TableOf begins() const
    {
        TableOf out = *this;
        out.begin = [](void* object) { F(*static_cast<Object*>(object)); };
        return out;
    }
    /// F: void(const Object&, const Checker&)
    template <auto F>
    constexpr TableOf checks() const
    {
        TableOf out = *this;
        out.check = [](const void* object, const Checker& to) { F(*static_cast<const Object*>(object), to); };
        return out;
    }
};

template <auto F>
constexpr Key Key::of_solids(const Table& other) const
{
    using Owner = typename detail::Function<decltype(F)>::Owner;
    Key key = *this;
    key.solid_table = &other;
    key.solids = [](const void* object) { return F(*static_cast<const Owner*>(object)); };
    return key;
}

template <auto F>
constexpr Key Key::begins() const
{
    using Owner = typename detail::Function<decltype(F)>::Owner;
    Key key = *this;
    key.begin = [](void* object) { F(*static_cast<Owner*>(object)); };
    return key;
}

template <auto F>
constexpr Key Key::when() const
{
    using Owner = typename detail::Function<decltype(F)>::Owner;
    Key key = *this;
    key.present = [](const void* object) { return F(*static_cast<const Owner*>(object)); };
    return key;
}

template <auto F>
constexpr Key Key::reads() const
{
    using Owner = typename detail::Function<decltype(F)>::Owner;
    Key key = *this;
    key.own = [](const Field& from, void* object) { F(from, *static_cast<Owner*>(object)); };
    return key;
}

} // namespace taut::scene_file
