#pragma once
// C++ twin of kernels/shared/portable.glsl for kernels that run several elements at a time (`//! lanes`).
// What is not defined here, such a kernel must not use: it would not compile.

#include "taut/runtime/cpu/lane_records.hpp"

namespace taut::lanes {

/// A bit for each lane whose element is one of the first `count`.
TAUT_LANE uint active_lanes(uint count)
{
    uint out = 0;
    for (uint element = 0; element < count; ++element)
        out |= 1u << lane_of(element);
    return out;
}

/// Adds the number of lanes in `lanes` in which `happened` is true.
TAUT_LANE void count_events(uint& counter, Bool happened, uint lanes)
{
    if (const uint which = bits(happened) & lanes)
        __atomic_fetch_add(&counter, static_cast<uint>(__builtin_popcount(which)), __ATOMIC_RELAXED);
}

/// Adds one for each lane in `lanes` in which `happened` is true, each to a counter of its own.
TAUT_LANE void count_events(const CounterOfEach& counters, Bool happened, uint lanes)
{
    if (const uint which = bits(happened) & lanes)
        for (uint element = 0; element < kLanes; ++element)
            if (which >> lane_of(element) & 1u)
                __atomic_fetch_add(counters.base + counters.where[element], 1u, __ATOMIC_RELAXED);
}

/// As taut::native::run_lean: with `report` a constant 0 there is no counting in the loop. `run` is told
/// whether this is the loop that most passes take, as a type.
template <typename Kernel, typename Run>
TAUT_LANE void run_lean(Kernel& kernel, Run run)
{
    constexpr bool reports = requires { kernel.report; };
    if constexpr (reports)
    {
        if (kernel.report == 0)
        {
            kernel.report = 0;
            run(kernel, std::true_type{});
            return;
        }
    }
    run(kernel, std::bool_constant<!reports>{});
}

/// Whether what a block's elements would index with is of a form.
template <typename Kernel>
TAUT_LANE bool is_of(Form form, Kernel& kernel, uint first)
{
    Lookout lookout(form);
    kernel.taut_active = 0; // no events
    kernel.element(Element<Form::any, true>{first, kLanes, &lookout});
    kernel.taut_active = active_lanes(kLanes);
    return lookout.agrees();
}

/// The form of a block; that of the block before is tried first.
template <typename Kernel>
TAUT_LANE Form form_of(Kernel& kernel, uint first, Patience& patience)
{
    if (!patience.wants_look())
        return Form::any;
    Form form = patience.likely();
    if (!is_of(form, kernel, first))
    {
        form = other_than(form);
        if (!is_of(form, kernel, first))
            form = Form::any;
    }
    patience.found(form);
    return form;
}

/// Elements first .. first + 7, with code of its own for every form.
template <typename Kernel>
TAUT_LANE void run_block(Kernel& kernel, uint first, Form form)
{
    switch (form)
    {
    case Form::run: return kernel.element(Element<Form::run>{first});
    case Form::pairs: return kernel.element(Element<Form::pairs>{first});
    case Form::any: return kernel.element(Element<Form::any>{first});
    }
}

/// Runs the elements of a KERNEL in whole blocks. Gives the first element back that is left.
template <typename Kernel>
[[gnu::flatten]] uint run_elements(const void* params, void* const* buffers, uint begin, uint end)
{
    Kernel kernel;
    kernel.bind(params, buffers);
    const uint count = kernel.element_count();
    if (end > count)
        end = count;
    if (end < begin + kLanes || end < begin)
        return begin;
    const uint blocks = (end - begin) / kLanes;
    run_lean(kernel, [=](Kernel& k, auto lean) __attribute__((always_inline)) {
        Patience patience;
        for (uint block = 0; block < blocks; ++block)
        {
            const uint first = begin + block * kLanes;
            const Form form = lean ? form_of(k, first, patience) : Form::any;
            run_block(k, first, form);
        }
    });
    return begin + blocks * kLanes;
}

template <typename Kernel>
[[gnu::flatten]] uint run_groups(const void* params, void* const* buffers, uint begin, uint end)
{
    Kernel kernel;
    kernel.bind(params, buffers);
    run_lean(kernel, [=](Kernel& k, auto) __attribute__((always_inline)) {
        for (uint group = begin; group < end; ++group)
            k.body(group);
    });
    return end;
}

/// The elements first .. end - 1 in blocks; the last one may be short. `active` is set to what `body` may
/// count.
template <typename Body>
TAUT_LANE void each(uint& active, uint first, uint end, Body body)
{
    active = active_lanes(kLanes);
    uint i = first;
    for (; end - i >= kLanes; i += kLanes)
        body(Element<Form::any>{i});
    if (i == end)
        return;
    active = active_lanes(end - i);
    body(Element<Form::any>{i, end - i});
}

} // namespace taut::lanes

#define INOUT(T) T&
#define PRECISE
#define INLINE TAUT_LANE
#define LAYOUT_STRUCT(name) struct name : taut::lanes::RecordTypes
#define REAL(x) real(x)
#define ELEMENT auto
#define SELECT(condition, a, b) taut::lanes::select(condition, a, b)
#define ANY(condition) (taut::lanes::bits(condition) != 0)

#define PARAMS struct
#define READ(slot, T, name) taut::lanes::Read<T> name
#define READ_ONE(slot, T, name) taut::lanes::One<T> name
#define WRITE(slot, T, name) taut::lanes::Update<T> name
#define UPDATE(slot, T, name) taut::lanes::Update<T> name
#define GROUP_UPDATE(slot, T, name) taut::lanes::Update<T> name
#define COUNTERS(slot, name) taut::lanes::Counters name
#define COUNT_EVENT_IF(condition, buffer, index) \
    taut::lanes::count_events(buffer[index], condition, taut_active)

#define KERNEL(count)                                                                                        \
    std::uint32_t element_count() const { return std::uint32_t(count); }                                     \
    TAUT_LANE void element(const ELEMENT i)

#define GROUP_KERNEL(size) void body(const uint group)

#define EACH_BEGIN(first, end)                                                                               \
    taut::lanes::each(taut_active, uint(first), uint(end),                                                   \
                      [&](const ELEMENT i) __attribute__((always_inline)) {
#define EACH_END });
