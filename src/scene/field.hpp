#pragma once
// A value of the scene file with its path, so that every refusal can say where it is.

#include <nlohmann/json.hpp>

#include <glm/vec3.hpp>

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

struct Table;

/// What a reader throws once it has put a mistake on a list; attempt() goes on behind it.
struct Listed
{};

/// What it throws where the list is full.
struct ListFull
{};

/// Mistakes that are listed of one file; who has more of them has made one of them a million times.
inline constexpr std::size_t kMostIssues = 1000;

/// A view of one JSON value. All readers throw Error{bad_input}: file, path, what is there, what
/// would be right. With a list of issues they put it there instead, and what can be read is read. Only types
/// are checked here; ranges are the business of check().
class Field
{
public:
    /// `issues`: null, or where mistakes are listed; must outlive the view, as the others do.
    Field(const nlohmann::json& value, const std::string& file, std::string path,
          std::vector<SceneIssue>* issues = nullptr);

    /// Does `part`; what it lists ends it, and nothing else.
    static void attempt(const std::function<void()>& part);

    /// Calls `read` with each element of a list; a mistake ends that element only.
    template <typename Read>
    void each(const Read& read) const
    {
        for (const Field& element : elements())
            attempt([&] { read(element); });
    }

    /// Refuses anything but an object whose keys are all in the table, which must outlive the view.
    const Field& object(const Table& table);

    /// The member of an object, if the file has it. `key`, of the table, must outlive what is handed out.
    std::optional<Field> find(std::string_view key) const;

    double number() const;
    /// Whole, 0..2^32-1. `right`: what to say where it is not, in place of that.
    std::uint32_t count(std::string_view right = {}) const;
    bool boolean() const;
    std::string text() const;
    glm::dvec3 vector() const;
    std::vector<Field> elements() const;

    bool is_text() const { return value_->is_string(); }

    /// "FILE: PATH is FOUND; RIGHT"
    [[noreturn]] void refuse(const std::string& right) const;
    /// "FILE: PATH TEXT"
    [[noreturn]] void fail(const std::string& text) const;
    /// "FILE: PATH TEXT" of an object and one of its keys, which the file has or should have; listed under
    /// the path of the key, where it is `listed`.
    [[noreturn]] void fail_at(std::string_view key, const std::string& text, const std::string& listed) const;

private:
    static constexpr std::size_t kNoIndex = ~std::size_t(0);

    std::string path() const;
    std::string path_of(std::string_view key) const;

    const nlohmann::json* value_;
    const std::string* file_;
    // "BASE[INDEX].KEY", put together where a mistake or a list within asks for it: a list has millions of
    // elements. No key of a table is empty.
    std::shared_ptr<const std::string> base_;
    std::size_t index_ = kNoIndex;
    std::string_view key_; // of a table
    const Table* table_ = nullptr;
    std::vector<SceneIssue>* issues_;
};

} // namespace taut::scene_file
