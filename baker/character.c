/* SPDX-License-Identifier: MIT */
#include "character.h"

#include <string.h>

limn_bake_status limni_list_add(limni_context *context, limni_list *list, const void *items,
                                size_t count, size_t size) {
    if (count >= LIMN_FORMAT_NONE - list->count)
        return limni_fail(context, LIMN_BAKE_BAD_INPUT,
                          "characters: keys, names or images of 4 GiB or more");
    if (list->count + count > list->room) {
        const size_t room = list->count + count + list->room;
        void *const moved = limni_resize(context, list->items, room, size);
        if (!moved) return LIMN_BAKE_MEMORY;
        list->items = moved;
        list->room = room;
    }
    if (count) memcpy((unsigned char *)list->items + list->count * size, items, count * size);
    list->count += (uint32_t)count;
    return LIMN_BAKE_OK;
}

limn_bake_status limni_character_add_text(limni_context *context, limni_character *character,
                                          const char *text, uint32_t *offset) {
    *offset = character->strings.count;
    return limni_list_add(context, &character->strings, text, strlen(text) + 1, 1);
}
