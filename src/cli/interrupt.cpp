#include "taut/cli/interrupt.hpp"

#include <csignal>

namespace taut::cli {
namespace {

volatile std::sig_atomic_t received = 0;

extern "C" void receive(int) { received = 1; }

} // namespace

InterruptGuard::InterruptGuard()
{
    received = 0;
    struct sigaction action = {};
    action.sa_handler = receive;
    // The handler serves once; SA_RESTART keeps a read or write in flight whole.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

InterruptGuard::~InterruptGuard()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::interrupted() const { return received != 0; }

} // namespace taut::cli
