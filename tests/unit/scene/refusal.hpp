#pragma once
// What a scene is refused with.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

#include <string>

/// The message of the error with which a scene does not resolve; "nothing" where it does.
inline std::string refusal(const taut::Scene& scene)
{
    try
    {
        taut::resolve(scene);
    }
    catch (const taut::Error& error)
    {
        return error.what();
    }
    return "nothing";
}

/// The same of a scene file's text, which may be refused before that.
inline std::string refusal(const std::string& json)
{
    try
    {
        return refusal(taut::parse_scene(json));
    }
    catch (const taut::Error& error)
    {
        return error.what();
    }
}
