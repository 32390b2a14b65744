// Trials of a line search at most: the whole step and 16 halvings of it, each half of the one before.
#ifndef TAUT_SHARED_LINE_SEARCH_H
#define TAUT_SHARED_LINE_SEARCH_H

#define TAUT_TRIALS 17

#endif
