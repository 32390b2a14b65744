#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_RUNNER
#endif
#include "support/skip.hpp"

#include <iostream>

int main(int argc, char** argv)
{
    Catch::Session session;
    if (const int wrong = session.applyCommandLine(argc, argv); wrong != 0)
        return wrong;
    // A test case that asserts nothing cannot fail.
    Catch::ConfigData& config = session.configData();
    config.warnings = static_cast<Catch::WarnAbout::What>(config.warnings | Catch::WarnAbout::NoAssertions);
    const bool passed = session.run() == 0; // else how many failed, which may be kSkipped
    for (const std::string& what : taut::left_out_so_far())
        std::cerr << "skipped: " << what << '\n';
    return !passed ? 1 : taut::left_out_so_far().empty() ? 0 : taut::kSkipped;
}
