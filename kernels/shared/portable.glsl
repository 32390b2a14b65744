// The only GLSL that knows which compiler reads it. Its C++ twin is runtime/cpu/portable.hpp.
//
// A kernel includes this first and then uses:
//   PARAMS { uint count; };            values fixed per dispatch; 32-bit scalars only
//   READ(slot, T, name)                storage buffer, read only
//   READ_ONE(slot, T, name)            the same for a buffer of one element, name[0]
//   WRITE(slot, T, name)               storage buffer, every element it owns is written
//   UPDATE(slot, T, name)              storage buffer, read and written
//   GROUP_UPDATE(slot, T, name)        the same where invocations of one group hand it to each other
//                                      across phases
//   KERNEL(count) { ... i ... }        one invocation per element
//   GROUP_KERNEL(size) { ... group ... PHASE_BEGIN ... lane ... PHASE_END ... }
//   LANES_BEGIN(n) ... lane ... LANES_END   a phase of the first n lanes only
//   EACH_BEGIN(first, end) ... i, lane ... EACH_END   a phase in which the lanes share the elements
//                                      first..end-1, element `first + k` going to lane k % size, each
//                                      lane in ascending order; on the CPU in the order of the elements
//   LINES_BEGIN(first, end, length) ... line ... LINE_BEGIN(inside) ... i, lane, line_first, line_last,
//   line_inside ... LINE_END LINES_END EACH over elements that lie in lines of `length` > 0: element i is in
//                                      line i / length, the flags say whether it is at an end of it, and
//                                      what is the same for a whole line stands before LINE_BEGIN. The CPU
//                                      has code of its own for lines for which `inside` holds, on devices
//                                      line_inside is false: a shorter way to the same bits
//   SLICES_BEGIN(first, end) ... slice ... PER_ROW(T, name) ...
//   SLICE_ROWS_BEGIN ... r, lane ... SLICE_ROWS_END
//   SLICE_STEPS_BEGIN(n) ... k, r, lane ... SLICE_STEPS_END
//   SLICES_END                         a phase over slices of 32 rows, a row a lane, slices first..end-1
//                                      going round; a row's own values are PER_ROW and used as ROW(name). All
//                                      rows of a slice make the same n steps; the CPU makes a step for all
//                                      rows at once. SLICE_ROWS_END SLICE_ROWS_BEGIN within a step cuts it
//                                      in two loops
//   SHARED(T, name, n)                 work-group memory; what lives across phases
//   COUNTERS(slot, name)               storage buffer of event counters, only touched by COUNT_EVENT
//   COUNT_EVENT(name, index)           counts on the device; integers, so order does not matter
//   NEXT_EVENT(name, index)            the same, and what was counted before: which invocation gets which
//                                      number is chance, so nothing may depend on it
//   PREFETCH(name, index)              name[index] and its neighbours are wanted soon; past the end is
//                                      allowed
//   WIDE                               a uint, on the CPU as wide as a pointer: for sums that index buffers
//   ADD_TWO(sum, a, k, b0, b1)         sum = (sum + a[k] b0) + a[k + 1] b1; on the CPU both products are one
//                                      instruction
//   DECLARE(void f(uint a)) ... APART void f(uint a) { ... }   a function behind the kernel's body, so that
//                                      it can hold phases; the native build never inlines it, which leaves
//                                      a hot loop the registers
//   INLINE f(...) { ... }              a function that the native build puts where it is called, whatever its
//                                      size, because it hands structures on
//   rbool, SELECT(c, a, b), ANY(c), ELEMENT, COUNT_EVENT_IF(c, name, index)   see below
//   IS_FINITE(value)                   by its bits: drivers may take a comparison for one without NaN, and a
//                                      difference of equals for zero
//   REAL(0.1)                          a constant of type real with all its digits; GLSL cannot paste a
//                                      suffix to a number, so flattening writes 0.1f or 0.1lf instead
// `real`, `rvec3`, `rvec4` are float or double, chosen when the kernel is compiled
// (TAUT_REAL_DOUBLE). Write real(0.5) for numbers that float holds exactly and REAL(0.1) for others,
// vec3(p) not p.xyz, INOUT(T) for out parameters.
//
// A kernel with the line `//! lanes` also runs several elements at a time on the CPU (docs/lanes.md). It may
// only be dispatched over elements that do not touch what others write. Its `real` is then one number per
// element, so what is true of one need not be of the next, and it says
//   rbool                              for the result of a comparison of reals (uints are the same for all)
//   SELECT(c, a, b)                    for c ? a : b, both of which are worked out
//   if (ANY(c))                        for a branch that may be left out when c is false for all
//   ELEMENT                            for the type of an index of elements, as `i` of KERNEL and EACH is
//   COUNT_EVENT_IF(c, name, index)     for if (c) COUNT_EVENT(name, index)
#ifndef __cplusplus
#ifndef TAUT_SHARED_PORTABLE_GLSL
#define TAUT_SHARED_PORTABLE_GLSL

#if TAUT_REAL_DOUBLE
#define real double
#define rvec3 dvec3
#define rvec4 dvec4
#else
#define real float
#define rvec3 vec3
#define rvec4 vec4
#endif

#define INOUT(T) inout T
#define PRECISE precise

#if TAUT_REAL_DOUBLE
bool taut_is_finite(double value) { return (unpackDouble2x32(value).y & 0x7FF00000u) != 0x7FF00000u; }
#else
bool taut_is_finite(float value) { return (floatBitsToUint(value) & 0x7F800000u) != 0x7F800000u; }
#endif
#define IS_FINITE(value) taut_is_finite(value)

// Drivers add the products of dot in different orders (Mesa's OpenGL last to first, its Vulkan first to
// last), and contract those of cross (Mesa from version 26 on). Written out, every executor adds as GLM does
// and results agree to the last bit. The kernel compiler refuses other built-ins that sum products.
real taut_dot(rvec3 a, rvec3 b)
{
    PRECISE real sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
}
real taut_dot(rvec4 a, rvec4 b)
{
    PRECISE real sum = (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
    return sum;
}
real taut_length(rvec3 a) { return sqrt(taut_dot(a, a)); }
real taut_length(rvec4 a) { return sqrt(taut_dot(a, a)); }
rvec3 taut_cross(rvec3 a, rvec3 b)
{
    PRECISE rvec3 area = rvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return area;
}
#define dot(a, b) taut_dot(a, b)
#define length(a) taut_length(a)
#define cross(a, b) taut_cross(a, b)
#define DECLARE(prototype) prototype;
#define rbool bool
#define ELEMENT uint
#define SELECT(condition, a, b) ((condition) ? (a) : (b))
#define ANY(condition) (condition)
#define APART
#define INLINE
#define LAYOUT_STRUCT(name) struct name

#ifdef VULKAN
#define PARAMS layout(push_constant) uniform ParamsBlock
#else
#define PARAMS layout(std140, binding = 0) uniform ParamsBlock
#endif

#define READ(slot, T, name) layout(std430, binding = slot) readonly buffer name##_block { T name[]; }
#define READ_ONE(slot, T, name) READ(slot, T, name)
#define WRITE(slot, T, name) \
    layout(std430, binding = slot) writeonly buffer name##_block { PRECISE T name[]; }
#define UPDATE(slot, T, name) layout(std430, binding = slot) buffer name##_block { PRECISE T name[]; }
#define GROUP_UPDATE(slot, T, name) \
    layout(std430, binding = slot) coherent buffer name##_block { PRECISE T name[]; }
#define COUNTERS(slot, name) layout(std430, binding = slot) buffer name##_counters { uint name[]; }
#define SHARED(T, name, n) shared PRECISE T name[n]
#define COUNT_EVENT(buffer, index) atomicAdd(buffer[index], 1u)
#define NEXT_EVENT(buffer, index) atomicAdd(buffer[index], 1u)
#define COUNT_EVENT_IF(condition, buffer, index) if (condition) COUNT_EVENT(buffer, index)
#define ADD_TWO(sum, a, k, b0, b1) sum = (sum + a[k] * (b0)) + a[(k) + 1u] * (b1)
#define PREFETCH(buffer, index)
#define WIDE uint

// Groups beyond the limit of one dimension are folded into y (runtime: fold_groups).
#define TAUT_GROUP (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x)

#define KERNEL(count)                                               \
    layout(local_size_x = TAUT_GROUP_SIZE) in;                      \
    void element(uint i);                                           \
    void main()                                                     \
    {                                                               \
        uint taut_i = TAUT_GROUP * uint(TAUT_GROUP_SIZE) + gl_LocalInvocationID.x; \
        if (taut_i < uint(count)) element(taut_i);                  \
    }                                                               \
    void element(uint i)

#define GROUP_KERNEL(size)            \
    layout(local_size_x = size) in;   \
    void body(uint group);            \
    void main() { body(TAUT_GROUP); } \
    void body(uint group)

#define PHASE_BEGIN               \
    {                             \
        uint lane = gl_LocalInvocationID.x;
#define TAUT_PHASE_BARRIER   \
    memoryBarrierBuffer();   \
    memoryBarrierShared();   \
    barrier();
#define PHASE_END            \
    }                        \
    TAUT_PHASE_BARRIER

#define LANES_BEGIN(n)                           \
    {                                            \
        uint lane = gl_LocalInvocationID.x;      \
        if (lane < uint(n))                      \
        {
#define LANES_END            \
        }                    \
    }                        \
    TAUT_PHASE_BARRIER

#define EACH_BEGIN(first, end)                                                             \
    {                                                                                      \
        uint lane = gl_LocalInvocationID.x;                                                \
        for (uint i = uint(first) + lane; i < uint(end); i += uint(gl_WorkGroupSize.x))    \
        {
#define EACH_END             \
        }                    \
    }                        \
    TAUT_PHASE_BARRIER

#define LINES_BEGIN(first, end, length)     \
    EACH_BEGIN(first, end)                  \
    uint taut_length = uint(length);        \
    uint line = i / taut_length;
#define LINE_BEGIN(inside)                                        \
    const bool line_inside = false;                               \
    bool line_first = i == line * taut_length;                    \
    bool line_last = i + 1u == (line + 1u) * taut_length;
#define LINE_END
#define LINES_END EACH_END

#define SLICES_BEGIN(first, end)                                                                       \
    {                                                                                                  \
        uint lane = gl_LocalInvocationID.x;                                                            \
        uint r = lane % 32u;                                                                           \
        for (uint slice = uint(first) + lane / 32u; slice < uint(end); slice += gl_WorkGroupSize.x / 32u) \
        {
#define PER_ROW(T, name) T name
#define ROW(name) name
#define SLICE_ROWS_BEGIN {
#define SLICE_ROWS_END }
#define SLICE_STEPS_BEGIN(n)              \
    for (uint k = 0u; k < uint(n); ++k)   \
    {                                     \
        SLICE_ROWS_BEGIN
#define SLICE_STEPS_END      \
        SLICE_ROWS_END       \
    }
#define SLICES_END           \
        }                    \
    }                        \
    TAUT_PHASE_BARRIER

#endif
#endif
