#pragma once
// Reads an object of the scene file as its table says.

#include "taut/scene/descriptor.hpp"
#include "taut/scene/field.hpp"

namespace taut::scene_file {

/// Puts the keys that are there into `object`, which is of the table's struct; what is left out keeps its
/// default. Throws, or lists, as Field does. Ranges are the business of check_table(), but for values that a
/// word says ("rigid") or that stand for something in the struct.
/// Returns the field, of which the keys of `table` can be asked for.
Field read_table(Field field, const Table& table, void* object);

} // namespace taut::scene_file
