// Words that host and kernels agree on where the rows of a system in use change on the device.
#ifndef TAUT_SHARED_ACTIVE_ROWS_H
#define TAUT_SHARED_ACTIVE_ROWS_H

/// Of the control buffer of conjugate gradients (shared/layouts.h): how many work groups hold rows in use.
/// 0: all of them do.
#define TAUT_CONTROL_GROUPS 3

/// Of springs that may become constraints (acad): a spring; a constraint, stretched; a spring that was a
/// constraint in the substep before; a constraint, compressed. Constraints are the odd ones.
#define TAUT_ACAD_SPRING 0u
#define TAUT_ACAD_ROW 1u
#define TAUT_ACAD_RELEASED 2u
#define TAUT_ACAD_PRESSED 3u
#define TAUT_ACAD_IS_ROW(flag) (((flag) & 1u) != 0u)

/// Words of acad's control buffer: group counts of the passes that choose rows, of the pass that scans, of
/// the passes over rows, and of what runs once a solve; then how many rows and vertices of rows there are.
#define TAUT_ACAD_CHOOSE 0
#define TAUT_ACAD_SCAN 4
#define TAUT_ACAD_SOLVE 8
#define TAUT_ACAD_ONCE 12
#define TAUT_ACAD_ROWS 16
#define TAUT_ACAD_VERTICES 17
#define TAUT_ACAD_WORDS 20

/// Event counter behind those of reports: springs that are constraints in this substep or were in the last.
#define TAUT_EVENT_ACAD 4
#define TAUT_EVENT_WORDS 8

#define TAUT_NO_ROW 0xffffffffu

#endif
