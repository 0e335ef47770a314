/* SPDX-License-Identifier: MIT */
/*
 * Writes the meshes that the project ships: generate_meshes OUT_FOLDER.
 *
 * Each mesh is built here from tables of a few numbers, checked (every directed edge once, one
 * component, the Euler characteristic and boundary it should have), and written aside and renamed.
 * Only + - * / and sqrt are used and every coordinate is rounded to 1e-4, so the files are the same
 * bytes on every host and compiler.
 *
 * The imp is modelled as one would by hand: half a cage of quads on x >= 0, limbs grown out of its
 * faces ring by ring, quads cut in two where triangles are wanted, the other half mirrored, and a
 * pose at the end.
 */
#include "imp_gltf.h"
#include "mesh.h"

#include <stdbool.h>
#include <string.h>

static const double grid = 10000.0; /* coordinates are multiples of 1 / grid */

/* ---- points ---- */

static double round_to_grid(double value) {
    return floor(value * grid + 0.5) / grid + 0.0; /* never -0 */
}

static void round_points(mesh *m) {
    for (int i = 0; i < m->point_count; ++i) {
        point *p = &m->points[i];
        *p = (point){round_to_grid(p->x), round_to_grid(p->y), round_to_grid(p->z)};
    }
}

/* ---- building ---- */

static int add_point(mesh *m, point p) {
    if (m->point_count == max_points) fail("mesh", "too many points");
    m->points[m->point_count] = p;
    return m->point_count++;
}

static int add_face(mesh *m, face f) {
    if (m->face_count == max_faces) fail("mesh", "too many faces");
    m->faces[m->face_count] = f;
    return m->face_count++;
}

static int add_triangle(mesh *m, int a, int b, int c) {
    return add_face(m, (face){3, {a, b, c}});
}

static int add_quad(mesh *m, int a, int b, int c, int d) {
    return add_face(m, (face){4, {a, b, c, d}});
}

static void add_crease(mesh *m, int a, int b, double sharpness) {
    if (m->crease_count == max_creases) fail("mesh", "too many creases");
    m->creases[m->crease_count++] = (crease){a, b, sharpness};
}

static int corner_after(const face *f, int corner) {
    return f->corners[(corner + 1) % f->count];
}

/* Some faces of a mesh that grow together; they are edge-connected. */
typedef struct region {
    int count;
    int faces[2];
} region;

static bool region_has_edge(const mesh *m, region r, int from, int to) {
    for (int i = 0; i < r.count; ++i) {
        const face *f = &m->faces[r.faces[i]];
        for (int k = 0; k < f->count; ++k) {
            if (f->corners[k] == from && corner_after(f, k) == to) return true;
        }
    }
    return false;
}

/* The outline of a region, counter-clockwise, from a corner of its first face. */
static int region_outline(const mesh *m, region r, int first_corner, int outline[]) {
    int count = 0;
    int at = m->faces[r.faces[0]].corners[first_corner];
    do {
        outline[count++] = at;
        int next = -1;
        for (int i = 0; i < r.count && next < 0; ++i) {
            const face *f = &m->faces[r.faces[i]];
            for (int k = 0; k < f->count; ++k) {
                const int to = corner_after(f, k);
                if (f->corners[k] == at && !region_has_edge(m, r, to, at)) next = to;
            }
        }
        at = next;
    } while (at >= 0 && at != outline[0] && count < 2 * max_corners);
    return count;
}

/*
 * Lifts a region off the mesh and closes the gap with quads, walls, between the old outline and the
 * new one. The faces keep their numbers and become the cap. Edges in the mirror plane get no wall
 * when `open_in_plane`: the other half continues there. Returns the first wall; walls follow the
 * region's faces and their corners.
 */
static int extrude(mesh *m, region r, bool open_in_plane) {
    int lifted[max_points];
    for (int i = 0; i < max_points; ++i) {
        lifted[i] = -1;
    }
    const int first_wall = m->face_count;
    for (int i = 0; i < r.count; ++i) {
        const face f = m->faces[r.faces[i]];
        for (int k = 0; k < f.count; ++k) {
            const int a = f.corners[k];
            const int b = corner_after(&f, k);
            const bool in_plane = m->points[a].x == 0.0 && m->points[b].x == 0.0;
            if (region_has_edge(m, r, b, a) || (in_plane && open_in_plane)) continue;
            if (lifted[a] < 0) lifted[a] = add_point(m, m->points[a]);
            if (lifted[b] < 0) lifted[b] = add_point(m, m->points[b]);
            add_quad(m, a, b, lifted[b], lifted[a]);
        }
    }
    for (int i = 0; i < r.count; ++i) {
        face *f = &m->faces[r.faces[i]];
        for (int k = 0; k < f->count; ++k) {
            if (lifted[f->corners[k]] >= 0) f->corners[k] = lifted[f->corners[k]];
        }
    }
    return first_wall;
}

/* ---- limbs: regions grown along a path ---- */

typedef struct section {
    point centre;
    double side_radius, other_radius;
} section;

/*
 * `side` is the direction that side_radius is roughly measured in, t the direction of growth;
 * other_radius is measured along side x t. The outline starts at `first_corner` of the region's
 * first face and is laid on the profile below.
 */
typedef struct limb {
    region base;
    int first_corner;
    bool in_plane; /* half a limb, cut by the mirror plane */
    point side;
    int section_count;
    const section *sections;
    bool facing_z; /* sections lie across z instead of across the path, which may turn back */
} limb;

typedef struct profile_point {
    double side, other;
} profile_point;

static const profile_point hexagon[6] = {{0.866, -0.5}, {0.0, -1.0}, {-0.866, -0.5},
                                         {-0.866, 0.5}, {0.0, 1.0},  {0.866, 0.5}};
static const profile_point half_hexagon[4] = {{0.866, -0.5}, {0.0, -1.0}, {0.0, 1.0}, {0.866, 0.5}};
static const profile_point square[4] = {{0.8, -0.8}, {-0.8, -0.8}, {-0.8, 0.8}, {0.8, 0.8}};

static void place_section(mesh *m, const limb *l, point direction, const section *s) {
    const point other_axis = normalise(cross(l->side, direction));
    const point side_axis = normalise(cross(direction, other_axis));
    const profile_point *profile = l->base.count == 2 ? hexagon
                                   : l->in_plane      ? half_hexagon
                                                      : square;
    int outline[2 * max_corners];
    const int count = region_outline(m, l->base, l->first_corner, outline);
    for (int i = 0; i < count; ++i) {
        const point offset = add(scale(side_axis, profile[i].side * s->side_radius),
                                 scale(other_axis, profile[i].other * s->other_radius));
        m->points[outline[i]] = add(s->centre, offset);
    }
}

static point outline_centre(const mesh *m, const limb *l) {
    int outline[2 * max_corners];
    const int count = region_outline(m, l->base, l->first_corner, outline);
    point sum = {0.0, 0.0, 0.0};
    for (int i = 0; i < count; ++i) {
        sum = add(sum, m->points[outline[i]]);
    }
    if (l->in_plane) sum.x = 0.0;
    return scale(sum, 1.0 / count);
}

/* Grows the limb through all its sections; returns the first wall of the last one. */
static int grow(mesh *m, const limb *l) {
    int first_wall = -1;
    const point root = outline_centre(m, l);
    for (int i = 0; i < l->section_count; ++i) {
        const section *here = &l->sections[i];
        const point from = i > 0 ? l->sections[i - 1].centre : root;
        const point to = l->sections[i + 1 < l->section_count ? i + 1 : i].centre;
        first_wall = extrude(m, l->base, l->in_plane);
        place_section(m, l, l->facing_z ? along_z : normalise(subtract(to, from)), here);
    }
    return first_wall;
}

/* ---- the imp ---- */

/*
 * A ring of the trunk: half an octagon from the front, x = 0, round the left side to the back. The
 * front point lies `dip` lower than the others.
 */
typedef struct trunk_ring {
    double y, width, front, back, dip;
} trunk_ring;

enum { trunk_columns = 5 };

static const trunk_ring trunk[] = {
    {0.46, 0.32, 0.24, -0.27, 0.00}, /* hips */
    {0.68, 0.45, 0.43, -0.34, 0.00}, /* belly */
    {0.92, 0.35, 0.30, -0.27, 0.00}, /* under the arms */
    {1.08, 0.28, 0.20, -0.22, 0.00}, /* shoulders */
    {1.14, 0.21, 0.17, -0.19, 0.00}, /* neck */
    {1.17, 0.44, 0.42, -0.36, 0.00}, /* chin */
    {1.35, 0.62, 0.54, -0.50, 0.14}, /* mouth */
    {1.55, 0.66, 0.56, -0.58, 0.00}, /* cheeks */
    {1.92, 0.62, 0.50, -0.58, 0.00}, /* brow */
    {2.14, 0.40, 0.28, -0.38, 0.00}, /* crown */
};
enum { trunk_rings = sizeof trunk / sizeof trunk[0] };

/* The bands between rings, and the panels of a band from front to back. */
enum { band_hips, band_ribs, band_arms, band_collar, band_throat, band_jaw, band_snout, band_eyes };
enum { panel_front, panel_front_side, panel_back_side, panel_back, panel_count };
enum {
    crown_front = panel_count * (trunk_rings - 1),
    crown_back,
    seat_front,
    seat_back,
};

static int trunk_panel(int band, int panel) {
    return panel_count * band + panel;
}

static void build_trunk(mesh *m) {
    for (int r = 0; r < trunk_rings; ++r) {
        const trunk_ring ring = trunk[r];
        add_point(m, (point){0.0, ring.y - ring.dip, ring.front});
        add_point(m, (point){0.72 * ring.width, ring.y, 0.8 * ring.front});
        add_point(m, (point){ring.width, ring.y, 0.5 * (ring.front + ring.back)});
        add_point(m, (point){0.72 * ring.width, ring.y, 0.8 * ring.back});
        add_point(m, (point){0.0, ring.y, ring.back});
    }
    for (int r = 0; r + 1 < trunk_rings; ++r) {
        for (int k = 0; k < panel_count; ++k) {
            const int low = trunk_columns * r + k;
            const int high = low + trunk_columns;
            add_quad(m, low, low + 1, high + 1, high);
        }
    }
    const int top = trunk_columns * (trunk_rings - 1);
    const int crown = add_point(m, (point){0.0, trunk[trunk_rings - 1].y + 0.06, -0.05});
    const int seat = add_point(m, (point){0.0, trunk[0].y - 0.04, -0.03});
    add_quad(m, top, top + 1, top + 2, crown);
    add_quad(m, crown, top + 2, top + 3, top + 4);
    add_quad(m, seat, 2, 1, 0);
    add_quad(m, 4, 3, 2, seat);
}

enum { arm_sections = 5, thumb_sections = 2 };

/* An arm with its thumb. */
typedef struct arm_pose {
    section arm[arm_sections];
    section thumb[thumb_sections];
    point thumb_side;
} arm_pose;

static const arm_pose hanging_arm = {
    {
        {{0.46, 0.99, -0.01}, 0.14, 0.12},
        {{0.62, 0.84, 0.00}, 0.11, 0.11},
        {{0.73, 0.66, 0.06}, 0.11, 0.11},
        {{0.79, 0.52, 0.12}, 0.20, 0.15},
        {{0.80, 0.36, 0.17}, 0.16, 0.12},
    },
    {
        {{0.69, 0.48, 0.37}, 0.13, 0.12},
        {{0.65, 0.41, 0.46}, 0.10, 0.10},
    },
    {1.0, 0.0, 0.0},
};

static const arm_pose raised_arm = {
    {
        {{0.45, 0.98, -0.01}, 0.14, 0.12},
        {{0.64, 0.92, 0.01}, 0.11, 0.11},
        {{0.83, 0.94, 0.05}, 0.11, 0.11},
        {{0.99, 1.14, 0.11}, 0.20, 0.15},
        {{1.04, 1.34, 0.13}, 0.17, 0.13},
    },
    {
        {{0.92, 1.25, 0.36}, 0.12, 0.11},
        {{0.85, 1.34, 0.43}, 0.10, 0.10},
    },
    {-1.0, 0.0, 0.0},
};

static void grow_arm(mesh *m, const arm_pose *pose) {
    const int panels[] = {trunk_panel(band_arms, panel_front_side),
                          trunk_panel(band_arms, panel_back_side)};
    const region side = {2, {panels[0], panels[1]}};
    const int wall = grow(m, &(limb){side, 0, false, along_z, arm_sections, pose->arm, false});
    const region front = {1, {wall + 2}};
    grow(m, &(limb){front, 0, false, pose->thumb_side, thumb_sections, pose->thumb, false});
}

static void grow_leg(mesh *m) {
    static const section leg[] = {
        {{0.23, 0.32, -0.02}, 0.20, 0.19},
        {{0.27, 0.14, -0.02}, 0.17, 0.15},
        {{0.28, -0.02, -0.02}, 0.20, 0.18},
    };
    static const section foot[] = {
        {{0.31, 0.07, 0.28}, 0.24, 0.13},
        {{0.34, 0.05, 0.48}, 0.20, 0.09},
    };
    const region under = {2, {seat_front, seat_back}};
    const int wall = grow(m, &(limb){under, 3, false, along_z, 3, leg, false});
    const region front = {1, {wall + 1}};
    grow(m, &(limb){front, 0, false, along_x, 2, foot, false});
}

static void grow_tail(mesh *m) {
    static const section tail[] = {
        {{0.0, 0.52, -0.42}, 0.11, 0.11}, {{0.0, 0.42, -0.62}, 0.09, 0.09},
        {{0.0, 0.44, -0.84}, 0.08, 0.08}, {{0.0, 0.62, -1.00}, 0.07, 0.07},
        {{0.0, 0.80, -1.04}, 0.07, 0.07}, {{0.0, 0.88, -1.04}, 0.28, 0.09},
        {{0.0, 1.18, -1.00}, 0.02, 0.03},
    };
    const region back = {1, {trunk_panel(band_hips, panel_back)}};
    grow(m, &(limb){back, 0, true, along_x, 7, tail, false});
}

static void grow_face(mesh *m) {
    static const section jaw[] = {{{0.0, 1.155, 0.58}, 0.27, 0.07}};
    static const section snout[] = {{{0.0, 1.415, 0.64}, 0.33, 0.145},
                                    {{0.0, 1.45, 0.78}, 0.18, 0.10}};
    static const section eye[] = {
        {{0.26, 1.77, 0.62}, 0.27, 0.24},
        {{0.26, 1.77, 0.55}, 0.20, 0.20},
        {{0.25, 1.77, 0.76}, 0.18, 0.18},
    };
    const region chin = {1, {trunk_panel(band_jaw, panel_front)}};
    const region nose = {1, {trunk_panel(band_snout, panel_front)}};
    const region lid = {1, {trunk_panel(band_eyes, panel_front)}};
    grow(m, &(limb){chin, 2, true, along_x, 1, jaw, true});
    grow(m, &(limb){nose, 2, true, along_x, 2, snout, true});
    grow(m, &(limb){lid, 2, false, along_x, 3, eye, true});
}

static void grow_ear(mesh *m) {
    static const section ear[] = {
        {{0.74, 1.70, -0.16}, 0.10, 0.15},
        {{0.98, 1.82, -0.22}, 0.07, 0.27},
        {{1.30, 2.12, -0.32}, 0.02, 0.04},
    };
    const region side = {1, {trunk_panel(band_eyes, panel_back_side)}};
    grow(m, &(limb){side, 0, false, along_z, 3, ear, false});
}

static void grow_horn(mesh *m) {
    static const section horn[] = {
        {{0.20, 2.19, 0.06}, 0.11, 0.11},
        {{0.26, 2.32, 0.08}, 0.08, 0.08},
        {{0.26, 2.48, 0.00}, 0.02, 0.02},
    };
    const region top = {1, {crown_front}};
    grow(m, &(limb){top, 1, false, along_z, 3, horn, false});
}

/* ---- from half a cage to a whole one ---- */

static double squared_distance(const mesh *m, int a, int b) {
    const point d = subtract(m->points[a], m->points[b]);
    return dot(d, d);
}

/* Cuts every quad along its shorter diagonal, or the first if they are equal. */
static void cut_quads(mesh *m) {
    const int quad_count = m->face_count;
    for (int i = 0; i < quad_count; ++i) {
        const face f = m->faces[i];
        if (f.count != 4) continue;
        const int *c = f.corners;
        /* The margin keeps equal diagonals equal whatever the last bit says. */
        const double difference = squared_distance(m, c[1], c[3]) - squared_distance(m, c[0], c[2]);
        const int start = difference < -1e-9 ? 1 : 0;
        const int a = c[start], b = c[start + 1], d = c[start + 2], e = c[(start + 3) % 4];
        m->faces[i] = (face){3, {a, b, d}};
        add_triangle(m, a, d, e);
    }
}

/*
 * Adds the mirror image of `other`, a half mesh that differs from m in the places of its points and
 * in how its quads are cut at most. Points with x = 0 are shared.
 */
static void mirror(mesh *m, const mesh *other) {
    const int point_count = m->point_count;
    int image[max_points];
    for (int i = 0; i < point_count; ++i) {
        const point p = other->points[i];
        image[i] = m->points[i].x == 0.0 ? i : add_point(m, (point){-p.x, p.y, p.z});
    }
    for (int i = 0; i < other->face_count; ++i) {
        const face *const f = &other->faces[i];
        face reversed = {.count = f->count};
        for (int k = 0; k < f->count; ++k) {
            reversed.corners[k] = image[f->corners[f->count - 1 - k]];
        }
        add_face(m, reversed);
    }
}

static void pose_imp(mesh *m) {
    for (int i = 0; i < m->point_count; ++i) {
        m->points[i] = imp_pose_point(m->points[i]);
    }
}

static void build_imp_half(mesh *m, const arm_pose *pose) {
    build_trunk(m);
    grow_leg(m);
    grow_arm(m, pose);
    grow_tail(m);
    grow_face(m);
    grow_ear(m);
    grow_horn(m);
}

static void build_imp_of(mesh *m, bool cut) {
    static mesh other;
    other.point_count = other.face_count = 0;
    build_imp_half(m, &hanging_arm);
    build_imp_half(&other, &raised_arm);
    if (cut) {
        cut_quads(m);
        cut_quads(&other);
    }
    mirror(m, &other);
    pose_imp(m);
}

static void build_imp(mesh *m) {
    build_imp_of(m, true);
}

static void build_quad_imp(mesh *m) {
    build_imp_of(m, false);
}

/* ---- the torus, the sail and the cut cube ---- */

/* 4 x 4 quads. Quarter turns need no sine. */
static void add_torus_points(mesh *m) {
    static const double cosine[4] = {1.0, 0.0, -1.0, 0.0};
    static const double sine[4] = {0.0, 1.0, 0.0, -1.0};
    const double ring_radius = 1.0, tube_radius = 0.5;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double radius = ring_radius + tube_radius * cosine[j];
            add_point(m, (point){radius * cosine[i], tube_radius * sine[j], radius * sine[i]});
        }
    }
}

static void build_torus_of(mesh *m, bool alternating) {
    add_torus_points(m);
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const int a = 4 * i + j, b = 4 * i + (j + 1) % 4;
            const int c = 4 * ((i + 1) % 4) + (j + 1) % 4, d = 4 * ((i + 1) % 4) + j;
            const bool other = alternating && (i + j) % 2 == 1;
            add_triangle(m, a, b, other ? d : c);
            add_triangle(m, other ? b : a, c, d);
        }
    }
}

/* All quads cut the same way: every point has valence 6. */
static void build_torus(mesh *m) {
    build_torus_of(m, false);
}

/* Neighbours cut the other way: half of the points have valence 4, half 8. */
static void build_alternating_torus(mesh *m) {
    build_torus_of(m, true);
}

enum { sail_columns = 6, sail_rows = 8 };

/*
 * The cells of the sail, its head first: how each is cut, or a space where there is no cloth: a
 * window of three cells and a tear in the edge.
 */
static const char sail_cells[sail_rows][sail_columns + 1] = {
    "/\\/\\/\\", "\\/\\/\\/", "/\\/\\/\\", "/// //", "//  //", "///// ", "//////", "//////",
};

static point sail_point(int column, int row) {
    const double s = (double)column / sail_columns;
    const double t = (double)row / sail_rows;
    const double billow = 4.0 * s * (1.0 - s) * (1.0 - 0.6 * t);
    return (point){-0.7 + 1.4 * s * (1.0 - 0.7 * t), 2.0 * t, 0.4 * billow - 0.3 * s * t};
}

static void build_sail(mesh *m) {
    for (int row = 0; row <= sail_rows; ++row) {
        for (int column = 0; column <= sail_columns; ++column) {
            add_point(m, sail_point(column, row));
        }
    }
    for (int row = 0; row < sail_rows; ++row) {
        for (int column = 0; column < sail_columns; ++column) {
            const char cell = sail_cells[sail_rows - 1 - row][column];
            const int a = (sail_columns + 1) * row + column, b = a + 1;
            const int d = a + sail_columns + 1, c = d + 1;
            if (cell == '/') {
                add_triangle(m, a, b, c);
                add_triangle(m, a, c, d);
            } else if (cell == '\\') {
                add_triangle(m, a, b, d);
                add_triangle(m, b, c, d);
            }
        }
    }
}

/* A cube with one corner cut off: a triangle, three quads and three pentagons. */
static void build_cube(mesh *m) {
    static const point points[10] = {
        {-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1},
        {1, -1, 1},   {-1, 1, 1},  {0, 1, 1},   {1, 0, 1},  {1, 1, 0},
    };
    static const face faces[7] = {
        {4, {1, 0, 2, 3}},    {4, {0, 4, 6, 2}},    {4, {0, 1, 5, 4}}, {5, {4, 5, 8, 7, 6}},
        {5, {5, 1, 3, 9, 8}}, {5, {6, 7, 9, 3, 2}}, {3, {7, 8, 9}},
    };
    for (int i = 0; i < 10; ++i) {
        add_point(m, points[i]);
    }
    for (int i = 0; i < 7; ++i) {
        add_face(m, faces[i]);
    }
}

/* ---- the mug: quads, two octagons, creases, and a handle ---- */

enum { mug_columns = 8, mug_rings = 10, mug_lip = 5, handle_sections = 4 };

static const profile_point octagon[mug_columns] = {
    {1.0, 0.4142},   {1.0, -0.4142}, {0.4142, -1.0}, {-0.4142, -1.0},
    {-1.0, -0.4142}, {-1.0, 0.4142}, {-0.4142, 1.0}, {0.4142, 1.0},
};

/* From the foot up the outside, over the lip, and down the inside. */
static const struct {
    double y, radius;
} mug[mug_rings] = {{0.0, 0.36},  {0.16, 0.42}, {0.40, 0.44}, {0.66, 0.44}, {0.90, 0.44},
                    {1.05, 0.46}, {1.05, 0.40}, {0.80, 0.37}, {0.30, 0.36}, {0.12, 0.28}};

static const double handle_width = 0.08;
static const profile_point handle[handle_sections][2] = {
    {{0.60, 0.72}, {0.64, 0.86}}, /* towards the mug, and away from it */
    {{0.74, 0.62}, {0.84, 0.70}},
    {{0.74, 0.44}, {0.84, 0.36}},
    {{0.60, 0.34}, {0.64, 0.20}},
};

static int mug_point(int ring, int column) {
    return mug_columns * ring + column % mug_columns;
}

/* The band above `ring` has a hole in its first column: what is around it, as the handle's
 * sections are. */
static void mug_hole(int ring, bool upper, int hole[4]) {
    const int a = mug_point(ring, 0), b = mug_point(ring, 1);
    const int c = mug_point(ring + 1, 1), d = mug_point(ring + 1, 0);
    const int around[4] = {upper ? a : d, upper ? b : c, upper ? c : b, upper ? d : a};
    memcpy(hole, around, sizeof around);
}

static void add_handle(mesh *m, int from_ring, int to_ring) {
    int before[4], after[4];
    mug_hole(from_ring, true, before);
    for (int i = 0; i <= handle_sections; ++i) {
        if (i == handle_sections) {
            mug_hole(to_ring, false, after);
        } else {
            for (int k = 0; k < 4; ++k) {
                const profile_point p = handle[i][k / 2];
                const double z = k == 0 || k == 3 ? handle_width : -handle_width;
                after[k] = add_point(m, (point){p.side, p.other, z});
            }
        }
        for (int k = 0; k < 4; ++k) {
            add_quad(m, before[k], before[(k + 1) % 4], after[(k + 1) % 4], after[k]);
        }
        memcpy(before, after, sizeof before);
    }
}

static void build_mug(mesh *m) {
    enum { handle_top = 3, handle_foot = 1 };
    face foot = {.count = mug_columns}, inside = {.count = mug_columns};
    for (int r = 0; r < mug_rings; ++r) {
        for (int k = 0; k < mug_columns; ++k) {
            add_point(m, (point){mug[r].radius * octagon[k].side, mug[r].y,
                                 mug[r].radius * octagon[k].other});
        }
    }
    for (int k = 0; k < mug_columns; ++k) {
        for (int r = 0; r + 1 < mug_rings; ++r) {
            if (k == 0 && (r == handle_top || r == handle_foot)) continue;
            add_quad(m, mug_point(r, k), mug_point(r, k + 1), mug_point(r + 1, k + 1),
                     mug_point(r + 1, k));
        }
        inside.corners[k] = mug_point(mug_rings - 1, k);
        foot.corners[mug_columns - 1 - k] = mug_point(0, k);
        add_crease(m, mug_point(0, k), mug_point(0, k + 1), 10.0);
        add_crease(m, mug_point(mug_lip, k), mug_point(mug_lip, k + 1), 1.5);
    }
    add_face(m, foot);
    add_face(m, inside);
    add_handle(m, handle_top, handle_foot);
}

/* ---- checks ---- */

/* What there is to build, and what it must turn out to be. */
typedef struct recipe {
    const char *file_name;
    void (*build)(mesh *m);
    int boundary_count; /* closed loops of boundary edges; 0: a closed mesh */
    int euler;          /* points - edges + faces */
} recipe;

typedef struct directed_edge {
    int from, to;
} directed_edge;

static int list_edges(const mesh *m, const char *name, directed_edge edges[max_edges]) {
    int count = 0;
    for (int i = 0; i < m->face_count; ++i) {
        const face *f = &m->faces[i];
        for (int k = 0; k < f->count; ++k) {
            if (count == max_edges) fail(name, "too many edges");
            edges[count++] = (directed_edge){f->corners[k], corner_after(f, k)};
        }
    }
    return count;
}

static int find_edge(const directed_edge *edges, int count, int from, int to) {
    for (int i = 0; i < count; ++i) {
        if (edges[i].from == from && edges[i].to == to) return i;
    }
    return -1;
}

/* Spreads the smallest number over every component; one component leaves only zeros. */
static bool is_connected(const mesh *m, const directed_edge *edges, int count) {
    int label[max_points];
    for (int i = 0; i < m->point_count; ++i) {
        label[i] = i;
    }
    bool changed = true;
    while (changed) {
        changed = false;
        for (int i = 0; i < count; ++i) {
            int *from = &label[edges[i].from], *to = &label[edges[i].to];
            if (*from == *to) continue;
            *from = *to = *from < *to ? *from : *to;
            changed = true;
        }
    }
    for (int i = 0; i < m->point_count; ++i) {
        if (label[i] != 0) return false;
    }
    return true;
}

/* Follows the boundary edges, which must leave every point at most once, and counts their loops. */
static int count_boundaries(const char *name, const directed_edge *boundary, int count) {
    int next[max_points];
    for (int i = 0; i < max_points; ++i) {
        next[i] = -1;
    }
    for (int i = 0; i < count; ++i) {
        if (next[boundary[i].from] >= 0) fail(name, "two boundaries meet in a point");
        next[boundary[i].from] = boundary[i].to;
    }
    int loops = 0;
    for (int i = 0; i < count; ++i) {
        int at = boundary[i].from;
        if (next[at] < 0) continue;
        ++loops;
        while (next[at] >= 0) {
            const int to = next[at];
            next[at] = -1;
            at = to;
        }
    }
    return loops;
}

/* Every face has an area, and six times the enclosed volume of a closed mesh is positive. */
static void check_shape(const mesh *m, const recipe *r) {
    double volume = 0.0;
    for (int i = 0; i < m->face_count; ++i) {
        const face *f = &m->faces[i];
        for (int k = 1; k + 1 < f->count; ++k) {
            const point a = m->points[f->corners[0]];
            const point b = m->points[f->corners[k]];
            const point c = m->points[f->corners[k + 1]];
            const point normal = cross(subtract(b, a), subtract(c, a));
            if (dot(normal, normal) < 1e-8) fail(r->file_name, "a face without area");
            volume += dot(a, cross(b, c));
        }
    }
    if (r->boundary_count == 0 && volume <= 0.0) fail(r->file_name, "inside out");
}

static void check_mesh(const mesh *m, const recipe *r) {
    static directed_edge edges[max_edges], boundary[max_edges];
    const int count = list_edges(m, r->file_name, edges);
    int boundary_edges = 0;
    for (int i = 0; i < count; ++i) {
        const directed_edge e = edges[i];
        if (find_edge(edges, count, e.from, e.to) != i) fail(r->file_name, "an edge is used twice");
        if (find_edge(edges, count, e.to, e.from) < 0) boundary[boundary_edges++] = e;
    }
    const int edge_count = (count + boundary_edges) / 2;
    if (!is_connected(m, edges, count)) fail(r->file_name, "not one connected mesh");
    if (count_boundaries(r->file_name, boundary, boundary_edges) != r->boundary_count) {
        fail(r->file_name, "an unexpected number of boundaries");
    }
    if (m->point_count - edge_count + m->face_count != r->euler) {
        fail(r->file_name, "an unexpected Euler characteristic");
    }
    check_shape(m, r);
}

/* ---- files ---- */

static const char origin[] = "# Made by assets/generate_meshes.c; MIT\n";

static void print_obj(const mesh *m, FILE *out) {
    fputs(origin, out);
    for (int i = 0; i < m->point_count; ++i) {
        const point p = m->points[i];
        fprintf(out, "v %.6f %.6f %.6f\n", p.x, p.y, p.z);
    }
    for (int i = 0; i < m->face_count; ++i) {
        fputs("f", out);
        for (int k = 0; k < m->faces[i].count; ++k) {
            fprintf(out, " %d", m->faces[i].corners[k] + 1);
        }
        fputs("\n", out);
    }
    for (int i = 0; i < m->crease_count; ++i) {
        const crease c = m->creases[i];
        fprintf(out, "t crease 2/1/0 %d %d %.1f\n", c.a, c.b, c.sharpness);
    }
}

static void print_off(const mesh *m, FILE *out) {
    fprintf(out, "OFF\n%s%d %d 0\n", origin, m->point_count, m->face_count);
    for (int i = 0; i < m->point_count; ++i) {
        const point p = m->points[i];
        fprintf(out, "%.6f %.6f %.6f\n", p.x, p.y, p.z);
    }
    for (int i = 0; i < m->face_count; ++i) {
        fprintf(out, "%d", m->faces[i].count);
        for (int k = 0; k < m->faces[i].count; ++k) {
            fprintf(out, " %d", m->faces[i].corners[k]);
        }
        fputs("\n", out);
    }
}

static void fail_file(const char *path) {
    perror(path);
    exit(EXIT_FAILURE);
}

static bool ends_with(const char *text, const char *end) {
    const size_t length = strlen(text), end_length = strlen(end);
    return length > end_length && strcmp(text + length - end_length, end) == 0;
}

/* Writes the file aside and renames it, so that a file that is there is whole. */
static void write_mesh(const mesh *m, const char *folder, const char *file_name) {
    char path[max_path], aside[max_path];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, file_name);
    const int aside_length = snprintf(aside, sizeof aside, "%s/%s.part", folder, file_name);
    if (length < 0 || aside_length < 0 || aside_length >= max_path) fail(folder, "path too long");
    FILE *out = fopen(aside, "wb");
    if (out == NULL) fail_file(aside);
    if (ends_with(file_name, ".gltf")) {
        imp_print_gltf(m, out);
    } else if (ends_with(file_name, ".off")) {
        print_off(m, out);
    } else {
        print_obj(m, out);
    }
    const bool failed = ferror(out) != 0;
    if (fclose(out) != 0 || failed) {
        remove(aside);
        fail(aside, "cannot be written");
    }
    if (rename(aside, path) != 0) fail_file(path);
}

int main(int argc, char **argv) {
    static const recipe recipes[] = {
        {"imp.obj", build_imp, 0, 2},
        {"torus32.obj", build_torus, 0, 0},
        {"torus32_alternating.obj", build_alternating_torus, 0, 0},
        {"sail.obj", build_sail, 2, 0},
        {"cube.off", build_cube, 0, 2},
        {"imp_quads.obj", build_quad_imp, 0, 2},
        {"mug.obj", build_mug, 0, 0},
        {"imp.gltf", build_imp, 0, 2},
    };
    static mesh m;
    if (argc != 2) {
        fputs("usage: generate_meshes OUT_FOLDER\n", stderr);
        return EXIT_FAILURE;
    }
    for (size_t i = 0; i < sizeof recipes / sizeof recipes[0]; ++i) {
        m.point_count = m.face_count = m.crease_count = 0;
        recipes[i].build(&m);
        round_points(&m);
        check_mesh(&m, &recipes[i]);
        write_mesh(&m, argv[1], recipes[i].file_name);
        printf("%s: %d points, %d faces\n", recipes[i].file_name, m.point_count, m.face_count);
    }
    return EXIT_SUCCESS;
}
