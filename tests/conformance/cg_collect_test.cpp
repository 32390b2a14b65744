#include "taut/kernels/cg_collect.hpp"

#include "support/cg_cases.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("cg_collect adds what was gained to the solution, or only clears it", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "pair");
    const std::uint32_t words = variant == "pair" ? 2 : 1;
    const std::uint32_t add = GENERATE(0u, 1u);
    for (const Dealt& dealt : deals())
    {
        CAPTURE(variant, add, dealt.count);
        Random random(30 + dealt.count);
        std::vector<Real> base = random_reals<Real>(random, words * (dealt.count + 7));
        const auto x = random_reals<Real>(random, dealt.count + 7);
        for (std::size_t i = 1; words == 2 && i < base.size(); i += 2)
            base[i] *=
                base[i - 1] * Real(sizeof(Real) == 8 ? 0x1p-55 : 0x1p-26); // a low word of its high one
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"base", bytes_of(base)}, {"x", bytes_of(x)}};
        c.launches = {make_launch(kernels::cg_collect::info(variant, c.precision),
                                  kernels::cg_collect::Params{dealt.count, dealt.chunk(), add},
                                  dealt.dispatched())};
        Field& gained = c.expected["x"];
        for (std::uint32_t i = 0; i < dealt.count; ++i)
            gained.add(0, 0);
        add_unchanged(gained, x, dealt.count);
        Field& sum = c.expected["base"];
        for (std::uint32_t i = 0; i < dealt.count && words == 1; ++i)
        {
            const double exact = double(base[i]) + (add != 0 ? double(x[i]) : 0);
            sum.add(exact, add != 0 ? std::abs(exact) : 0);
        }
        if (words == 1)
            add_unchanged(sum, base, dealt.count);
        else
            c.expected.erase("base");
        look_on_every_device(c, [&](const Buffers& out) {
            const auto after = values_of<Real>(out.at("base"));
            for (std::uint32_t i = 0; words == 2 && i < dealt.count + 7; ++i)
            {
                const Real high = after[2 * i], low = after[2 * i + 1];
                if (add == 0 || i >= dealt.count)
                {
                    CHECK((high == base[2 * i] && low == base[2 * i + 1]));
                    continue;
                }
                const long double exact =
                    (long double)(base[2 * i]) + (long double)(base[2 * i + 1]) + (long double)(x[i]);
                const long double size = std::abs((long double)(base[2 * i])) + std::abs((long double)(x[i]));
                const long double unit =
                    sizeof(Real) == 8 ? 0x1p-62L : 0x1p-47L; // of what judges, or of pairs
                CHECK(std::abs((long double)(high) + (long double)(low)-exact) <= unit * size);
                CHECK(Real(high + low) == high); // the low word is below the last digit of the high one
            }
        });
    }
}

TEST_CASE("cg_collect in pairs of floats keeps 44 bits of a thousand additions of mixed sign")
{
    const std::uint32_t rows = 130, turns = 1000;
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        const auto device = test_device(selector);
        const BufferPtr base = device->make_buffer(rows * 8, "base"), x = device->make_buffer(rows * 4, "x");
        Recorder recorder(device);
        recorder.dispatch(kernels::cg_collect::Bindings<Recorder::Binding>{.base = base, .x = x},
                          {rows, 256, 1}, 1, {"pair"});
        const auto recording = recorder.finish();
        std::vector<long double> exact(rows, 0), largest(rows, 0);
        Random random(77);
        for (std::uint32_t turn = 0; turn < turns; ++turn)
        {
            auto step = random_reals<float>(random, rows);
            step[0] = turn % 2 == 0 ? 1.0f : -1.0f + 0x1p-20f;              // cancels all but the last digits
            step[1] = turn == 0 ? 1.0f : 0x1p-30f;                          // each one below the high word
            step[2] = turn % 3 == 0 ? 1e6f : turn % 3 == 1 ? -1e6f : 1e-6f; // comes and goes
            step[3] = -static_cast<float>(exact[3]) + step[3] * 0x1p-20f;   // back to zero every time
            for (std::uint32_t i = 0; i < rows; ++i)
            {
                exact[i] += (long double)(step[i]);
                largest[i] = std::max({largest[i], std::abs(exact[i]), std::abs((long double)(step[i]))});
            }
            device->write<float>(x, step);
            recording->replay();
        }
        const auto after = device->read<float>(base, 2 * rows);
        for (std::uint32_t i = 0; i < rows; ++i)
        {
            CAPTURE(i);
            const long double sum = (long double)(after[2 * i]) + (long double)(after[2 * i + 1]);
            // As large as the sum ever was: digits that a cancellation takes away are gone in any arithmetic.
            CHECK(std::abs(sum - exact[i]) <= 0x1p-44L * largest[i]);
        }
    }
}
