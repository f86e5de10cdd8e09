// Handles that tell what they stand for from what has come in its place since: a number, and how often the
// slot of that number was given away.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct vtSlot {
    uint32_t generation; ///< counts up when what it stood for goes
    uint32_t at;         ///< where that is kept
    bool used;
} vtSlot;

typedef struct vtSlots {
    vtSlot* slots;
    uint32_t count, capacity;
} vtSlots;

/// Room for one more; false where memory is out. After it vtSlots_Add cannot fail.
bool vtSlots_Reserve(vtSlots* slots);

/// A handle for what is kept at `at`: *index1 is its slot's number plus one, so never 0.
void vtSlots_Add(vtSlots* slots, uint32_t at, uint32_t* index1, uint32_t* generation);

/// Where what the handle stands for is kept; false where it is gone, or was never there.
bool vtSlots_Find(const vtSlots* slots, uint32_t index1, uint32_t generation, uint32_t* at);

/// The handle of what is kept at `at`; false where there is none.
bool vtSlots_HandleOf(const vtSlots* slots, uint32_t at, uint32_t* index1, uint32_t* generation);

/// What was kept at `at` is gone, and what was at `last` is there now.
void vtSlots_Remove(vtSlots* slots, uint32_t at, uint32_t last);

/// All are gone; handles given out before stay worthless.
void vtSlots_Clear(vtSlots* slots);
void vtSlots_Destroy(vtSlots* slots);
