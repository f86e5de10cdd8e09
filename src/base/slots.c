#include "base/slots.h"

#include "base/memory.h"

bool vtSlots_Reserve(vtSlots* slots)
{
    if (slots->count < slots->capacity) {
        return true;
    }
    const uint32_t capacity = slots->capacity > 0 ? 2 * slots->capacity : 16;
    vtSlot* grown = vtReallocate(slots->slots, capacity, sizeof *grown);
    if (grown == NULL) {
        return false;
    }
    slots->slots = grown;
    slots->capacity = capacity;
    return true;
}

void vtSlots_Add(vtSlots* slots, uint32_t at, uint32_t* index1, uint32_t* generation)
{
    uint32_t index = 0;
    while (index < slots->count && slots->slots[index].used) {
        ++index;
    }
    if (index == slots->count) {
        slots->slots[slots->count++] = (vtSlot){0};
    }
    vtSlot* slot = &slots->slots[index];
    slot->used = true;
    slot->at = at;
    *index1 = index + 1;
    *generation = slot->generation;
}

bool vtSlots_Find(const vtSlots* slots, uint32_t index1, uint32_t generation, uint32_t* at)
{
    const bool known = index1 > 0 && index1 <= slots->count;
    const vtSlot* slot = known ? &slots->slots[index1 - 1] : NULL;
    if (!known || !slot->used || slot->generation != generation) {
        return false;
    }
    *at = slot->at;
    return true;
}

static vtSlot* slotOf(const vtSlots* slots, uint32_t at)
{
    for (uint32_t i = 0; i < slots->count; ++i) {
        if (slots->slots[i].used && slots->slots[i].at == at) {
            return &slots->slots[i];
        }
    }
    return NULL;
}

bool vtSlots_HandleOf(const vtSlots* slots, uint32_t at, uint32_t* index1, uint32_t* generation)
{
    const vtSlot* slot = slotOf(slots, at);
    if (slot == NULL) {
        return false;
    }
    *index1 = (uint32_t)(slot - slots->slots) + 1;
    *generation = slot->generation;
    return true;
}

void vtSlots_Remove(vtSlots* slots, uint32_t at, uint32_t last)
{
    vtSlot* gone = slotOf(slots, at);
    if (gone != NULL) {
        gone->used = false;
        ++gone->generation;
    }
    vtSlot* moved = at != last ? slotOf(slots, last) : NULL;
    if (moved != NULL) {
        moved->at = at;
    }
}

void vtSlots_Clear(vtSlots* slots)
{
    for (uint32_t i = 0; i < slots->count; ++i) {
        slots->slots[i].generation += slots->slots[i].used;
        slots->slots[i].used = false;
    }
}

void vtSlots_Destroy(vtSlots* slots)
{
    vtFree(slots->slots);
    *slots = (vtSlots){0};
}
