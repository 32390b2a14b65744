// Words that host and kernels agree on where the rows of a system in use change on the device.
#ifndef TAUT_SHARED_ACTIVE_ROWS_H
#define TAUT_SHARED_ACTIVE_ROWS_H

/// Of the control buffer of conjugate gradients (shared/layouts.h): how many work groups hold rows in use.
/// 0: all of them do.
#define TAUT_CONTROL_GROUPS 3

#endif
