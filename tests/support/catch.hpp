#pragma once
// Catch2 2 and 3 under one include.

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp> // declares ::Approx itself
#endif
