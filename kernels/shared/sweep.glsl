// The two ways through a list of coloured constraints, for every kernel that has `project(ELEMENT k)`, the
// parameters `first` and `count`, and in the TAIL variant the buffer `table`.
#ifndef TAUT_SHARED_SWEEP_GLSL
#define TAUT_SHARED_SWEEP_GLSL

#if TAIL
// One group a run of small colours, or a small body: its colours one after another, the same sums in the
// same order as one dispatch a colour. Folded dispatches may bring groups too many; they have no colours.
GROUP_KERNEL(64)
{
    uint range = first + 2u * min(group, count - 1u);
    uint begin = table[range];
    uint end = group < count ? table[range + 1u] : begin;
    for (uint colour = begin; colour < end; ++colour)
    {
        EACH_BEGIN(table[colour], table[colour + 1u])
        project(i);
        EACH_END
    }
}
#else
KERNEL(count)
{
    project(first + i);
}
#endif

#endif
