// Flat shapes around the picture of a triangle through a round lens, after Gascuel, Holzschuch, Fournier and Péroche,
// "Fast Non-Linear Projections using Graphics Hardware" (I3D 2008); derivations in docs/bounded-raycast.md. Corners
// a, b, c are seen from the eye in lens axes (forward -z, x right, y up); a place in the picture is as in
// shaders/projections/radial.glsl, which comes before this file. Legal GLSL and legal C++ under GLM; C++ includes it
// through renderer/bounding_shapes.h.

// Triangles with corners 3 i, 3 i + 1, 3 i + 2. Those before number `before` are for the directions with
// dot(cut, direction) >= 0, the others for < 0, so that no fragment counts twice; a shape in one piece has the cut 0.
struct BoundingTriangles {
    int count;
    int before;
    real3 cut;
    real2 corners[12];
};

// Four corners in order around it, if `count` is 1.
struct BoundingQuad {
    int count;
    real2 corners[4];
};

const real kShapeQuarterTurn = 1.57079632679489662;
// Roundings of single precision in directions and what is made of them.
const real kShapeRounding = 2e-6;
const real kShapeNoArea = 1e30;
// A doubt with which a shape covers the whole disc.
const real kShapeNowhere = 1e6;

// A triangle cut by planes through the eye: unit directions in order around it, joined by arcs of less than half a
// turn. Where a cut falls between almost opposite directions, it is known to within `slack` only.
const int kShapeCorners = 6;
struct SeenPolygon {
    int count;
    real3 corners[kShapeCorners];
    real slack;
};

// What is seen of a polygon in the picture: within the hull of `points`, grown by `reach`. `outward` has the normals
// of its bounding lines in order around it, `turn` is 1 if that order is counter-clockwise and -1 otherwise.
const int kShapePoints = 24;
struct ShapeOutline {
    int points;
    real2 places[kShapePoints];
    int sides;
    real2 outward[kShapeCorners];
    real turn;
    real reach;
    real area;
    real girth;
};

struct ShapePolygon {
    int count;
    real2 corners[kShapeCorners];
    real area;
};

SHARED_FN real shapeCross(real2 a, real2 b) { return a.x * b.y - a.y * b.x; }

SHARED_FN real2 shapeUnit(real2 v) { return v / max(length(v), 1e-30); }

// Free of overflow; a corner in the eye has no direction and stays 0.
SHARED_FN real3 shapeDirection(real3 corner) {
    real most = max(max(abs(corner.x), abs(corner.y)), abs(corner.z));
    return most > 0.0 ? normalize(corner / most) : corner;
}

// ---- The lens ----------------------------------------------------------------------------------------------------

// One step of Newton's after a driver's atan, of which GLSL promises little.
SHARED_FN real shapeAngle(real3 direction) {
    real offAxis = length(real2(direction.x, direction.y));
    real angle = atan(offAxis, -direction.z);
    return angle + offAxis * cos(angle) + direction.z * sin(angle);
}

// Beyond its edge, where a polynomial may do anything, it goes on as a straight line.
SHARED_FN real shapeRadius(const real c[kRadialTerms], real edge, real angle) {
    real within = min(angle, edge);
    return polynomialRadius(c, within) + polynomialSlope(c, within) * (angle - within);
}

// Of a unit direction ahead. Four of the lenses are a factor on (x, y) that depends on z alone.
SHARED_FN real2 shapePlace(int model, const real c[kRadialTerms], real edge, real3 direction) {
    real2 side = real2(direction.x, direction.y);
    if (model == kOrthographic) return side;
    if (model == kStereographic) return side * (2.0 / (1.0 - direction.z));
    if (model == kEquisolid) return side * sqrt(2.0 / (1.0 - direction.z));
    real offAxis = length(side);
    real angle = shapeAngle(direction);
    real radius = model == kEquidistant ? angle : shapeRadius(c, edge, angle);
    return offAxis > 0.0 ? side * (radius / offAxis) : side;
}

// How the place moves as the direction moves along `step`; not for polynomials.
SHARED_FN real2 shapeMove(int model, real3 direction, real3 step) {
    real2 side = real2(direction.x, direction.y);
    real2 move = real2(step.x, step.y);
    real depth = 1.0 - direction.z;
    if (model == kOrthographic) return move;
    if (model == kStereographic) return move * (2.0 / depth) + side * (2.0 * step.z / (depth * depth));
    if (model == kEquisolid) return (move + side * (0.5 * step.z / depth)) * sqrt(2.0 / depth);
    real offAxis = length(side);
    real angle = shapeAngle(direction);
    real factor = angle > 0.0 ? angle / offAxis : 1.0;
    real growth = angle < 0.05 ? 1.0 / 3.0 + angle * angle * (2.0 / 15.0)
                               : (offAxis + angle * direction.z) / (offAxis * offAxis * offAxis);
    return move * factor + side * (growth * step.z);
}

// More than a place ahead moves for each radian that a direction is off.
SHARED_FN real shapeScale(int model, const real c[kRadialTerms], real edge) {
    if (model == kOrthographic) return 1.0;
    if (model != kPolynomial) return 2.0;
    real sum = 0.0;
    for (int i = kRadialTerms - 1; i >= 0; --i) sum = sum * edge + real(i + 1) * abs(c[i]);
    return sum * kShapeQuarterTurn;
}

// A bound of the second derivative of a polynomial's place along a great circle's arc with angles from `low` to
// `high` ahead, both at most the edge; `far` is the radius at the arc's far end.
SHARED_FN real polynomialBend(const real c[kRadialTerms], real low, real high, real far) {
    real middle = 0.5 * (low + high);
    real bend = 0.0;
    real slide = 0.0;
    real bendGrowth = 0.0;
    real slideGrowth = 0.0;
    for (int k = kRadialTerms; k >= 2; --k) {
        bend = bend * middle + real(k * (k - 1)) * c[k - 1];
        slide = slide * middle + real(k - 1) * c[k - 1];
    }
    for (int k = kRadialTerms; k >= 3; --k) {
        bendGrowth = bendGrowth * high + real(k * (k - 1) * (k - 2)) * abs(c[k - 1]);
        slideGrowth = slideGrowth * high + real((k - 1) * (k - 2)) * abs(c[k - 1]);
    }
    bend = abs(bend) + 0.5 * (high - low) * bendGrowth;
    slide = abs(slide) + 0.5 * (high - low) * slideGrowth;
    return length(real2(max(bend, slide + far), kShapeQuarterTurn * slide + 0.64 * far));
}

// ---- The part that is seen ---------------------------------------------------------------------------------------

SHARED_FN SeenPolygon seenTriangle(real3 a, real3 b, real3 c) {
    SeenPolygon seen;
    seen.corners[0] = shapeDirection(a);
    seen.corners[1] = shapeDirection(b);
    seen.corners[2] = shapeDirection(c);
    // From one of its corners a triangle is seen edge on.
    bool atEye = false;
    for (int i = 0; i < 3; ++i) atEye = atEye || dot(seen.corners[i], seen.corners[i]) < 0.5;
    seen.count = atEye ? 0 : 3;
    seen.slack = 0.0;
    return seen;
}

// What lies at dot(plane, direction) >= 0.
SHARED_FN SeenPolygon cutPolygon(SeenPolygon whole, real3 plane) {
    SeenPolygon part;
    part.count = 0;
    part.slack = whole.slack;
    for (int i = 0; i < whole.count; ++i) {
        real3 from = whole.corners[i];
        real3 to = whole.corners[i + 1 < whole.count ? i + 1 : 0];
        real here = dot(plane, from);
        real there = dot(plane, to);
        if (here >= 0.0) part.corners[part.count++] = from;
        if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
            real weight = 1.0 / (abs(here) + abs(there));
            real3 crossing = from * (abs(there) * weight) + to * (abs(here) * weight);
            real size = max(length(crossing), 1e-20);
            part.corners[part.count++] = crossing / size;
            part.slack = max(part.slack, 0.2 * kShapeRounding / size);
        }
    }
    return part;
}

// The azimuths of a polygon ahead or behind, relative to the unit direction `towards`, and whether they lie within
// half a turn: then the axis is outside the polygon.
struct ShapeAzimuths {
    bool beside;
    real2 towards;
    real least;
    real most;
};

SHARED_FN real2 shapeTurned(real2 v, real angle) {
    return real2(v.x * cos(angle) - v.y * sin(angle), v.x * sin(angle) + v.y * cos(angle));
}

SHARED_FN real shapeAzimuth(real2 towards, real3 direction) {
    real2 side = real2(direction.x, direction.y);
    return atan(shapeCross(towards, side), dot(towards, side));
}

SHARED_FN ShapeAzimuths azimuthsOf(SeenPolygon seen) {
    ShapeAzimuths azimuths;
    real2 sum = real2(0.0, 0.0);
    for (int i = 0; i < seen.count; ++i) sum += shapeUnit(real2(seen.corners[i].x, seen.corners[i].y));
    azimuths.towards = shapeUnit(sum);
    // Where they cancel out, as all around the axis, none is the middle.
    azimuths.beside = length(sum) > 5e-4;
    azimuths.least = kShapeQuarterTurn;
    azimuths.most = -kShapeQuarterTurn;
    for (int i = 0; i < seen.count; ++i) {
        real offAxis = length(real2(seen.corners[i].x, seen.corners[i].y));
        real azimuth = shapeAzimuth(azimuths.towards, seen.corners[i]);
        real doubt = (kShapeRounding + seen.slack) / max(offAxis, 1e-6);
        azimuths.least = min(azimuths.least, azimuth - doubt);
        azimuths.most = max(azimuths.most, azimuth + doubt);
        azimuths.beside = azimuths.beside && offAxis > 1e-6;
    }
    azimuths.beside = azimuths.beside && azimuths.most - azimuths.least < 2.0 * kShapeQuarterTurn - 1e-3;
    return azimuths;
}

// Whether the arc from a direction ahead to another comes nearer to the axis at first. Close to the axis z tells little.
SHARED_FN bool comesNearer(real3 from, real3 to) {
    real3 across = to - from;
    real3 away = across + from * (0.5 * dot(across, across));
    return from.z < -0.5 ? from.x * away.x + from.y * away.y < 0.0 : away.z < 0.0;
}

// Hardly more than the least angle from the axis ahead on the arc between directions ahead.
SHARED_FN real nearestOnArc(real3 from, real3 to) {
    real atEnds = min(shapeAngle(from), shapeAngle(to));
    // Where the arc comes nearer from both ends, its plane's point nearest to the axis is on it.
    if (!comesNearer(from, to) || !comesNearer(to, from)) return atEnds;
    real3 normal = cross(from, to);
    real between = atan(abs(normal.z), length(real2(normal.x, normal.y)));
    between -= 0.1 * kShapeRounding / max(length(normal), 1e-20);
    return min(atEnds, max(between, atEnds - 2.0 * length(to - from)));
}

// Less than any angle from the axis ahead (or behind) in a polygon that does not contain it, and hardly less.
SHARED_FN real nearestToAxis(SeenPolygon seen, bool ahead) {
    real nearest = 2.0 * kShapeQuarterTurn;
    for (int i = 0; i < seen.count; ++i) {
        real3 from = seen.corners[i];
        real3 to = seen.corners[i + 1 < seen.count ? i + 1 : 0];
        if (!ahead) {
            from.z = -from.z;
            to.z = -to.z;
        }
        nearest = min(nearest, nearestOnArc(from, to));
    }
    return nearest - kShapeRounding - seen.slack;
}

SHARED_FN SeenPolygon seenAhead(real edge, real3 a, real3 b, real3 c) {
    SeenPolygon seen = cutPolygon(seenTriangle(a, b, c), real3(0.0, 0.0, -1.0));
    if (edge >= kShapeQuarterTurn || seen.count == 0 || !azimuthsOf(seen).beside) return seen;
    if (nearestToAxis(seen, true) > edge) seen.count = 0;
    return seen;
}

// ---- Its outline -------------------------------------------------------------------------------------------------

// Where the tangents of a convex arc at its end and at its middle meet; both have length one and lead from the end to
// the middle. Unless they turn by more than a right angle, they meet no further away than the middle is.
SHARED_FN real2 tangentsMeet(real2 end, real2 away, real2 middle, real2 along) {
    real2 gap = middle - end;
    real rise = abs(shapeCross(gap, along));
    real turning = abs(shapeCross(away, along));
    real reach = length(gap);
    if (dot(away, along) <= 0.0) reach = kShapeNoArea;
    return end + away * (turning > 0.0 ? min(rise / turning, reach) : 0.5 * min(reach, length(gap)));
}

SHARED_FN ShapeOutline addPlace(ShapeOutline outline, real2 place) {
    outline.places[outline.points++] = place;
    return outline;
}

// A bounding line's normal, from the way of the side along it; a side without extent, as lenses show some at the horizon,
// has no way.
SHARED_FN ShapeOutline addLine(ShapeOutline outline, real2 along) {
    if (length(along) < 1e-12) return outline;
    outline.outward[outline.sides++] = shapeUnit(real2(along.y, -along.x)) * outline.turn;
    return outline;
}

// An arc from place p to q, through one of the four lenses whose curves are convex with the axis inside, and with the
// polygon on that side: its tangent parallel to the chord, or close to that (any tangent bounds a convex curve), and
// where it meets the tangents of the ends.
SHARED_FN ShapeOutline addBulge(ShapeOutline outline, int model, const real c[kRadialTerms], real edge, real3 from,
                                real3 to, real2 p, real2 q) {
    real3 across = to - from;
    real apart = length(across);
    real3 awayFrom = normalize(across + from * (0.5 * apart * apart));
    real3 awayTo = normalize(to * (0.5 * apart * apart) - across);

    // The extremum's angle from the first end is twice that of a mean of the ends in which they weigh differently.
    real skew = (1.0 - from.z) / (1.0 - to.z);
    real weight = 1.0;
    if (model == kStereographic) weight = sqrt(skew);
    if (model == kEquisolid) weight = sqrt(sqrt(skew));
    if (model == kEquidistant) weight = pow(skew, 1.0 / 3.0);
    real2 mean = shapeUnit(real2(1.0 + weight * 0.5 * length(from + to), weight * 0.5 * apart));
    real cosine = mean.x * mean.x - mean.y * mean.y;
    real sine = 2.0 * mean.x * mean.y;
    real3 middle = from * cosine + awayFrom * sine;

    real2 place = shapePlace(model, c, edge, middle);
    real2 along = shapeUnit(shapeMove(model, middle, awayFrom * cosine - from * sine));
    outline = addPlace(outline, tangentsMeet(p, shapeUnit(shapeMove(model, from, awayFrom)), place, along));
    outline = addPlace(outline, tangentsMeet(q, shapeUnit(shapeMove(model, to, awayTo)), place, -along));
    return addLine(outline, along);
}

// An arc through a polynomial: three places between its ends. Within a quarter of it the curve leaves the straight
// line by an eighth of the quarter squared times the bound of its second derivative, at most.
SHARED_FN ShapeOutline addSamples(ShapeOutline outline, const real c[kRadialTerms], real edge, real3 from, real3 to,
                                  real2 p, real2 q) {
    real3 middle = normalize(from + to);
    real quarter = 0.5 * atan(length(to - from), length(to + from));
    real most = min(edge, kShapeQuarterTurn);
    real angle = shapeAngle(middle);
    real low = clamp(angle - 2.0 * quarter, 0.0, most);
    real high = min(angle + 2.0 * quarter, kShapeQuarterTurn);
    real bend = polynomialBend(c, low, min(high, most), abs(shapeRadius(c, edge, high)));
    outline.reach = max(outline.reach, 0.125 * bend * quarter * quarter);
    outline = addPlace(outline, shapePlace(kPolynomial, c, edge, normalize(from + middle)));
    outline = addPlace(outline, shapePlace(kPolynomial, c, edge, middle));
    outline = addPlace(outline, shapePlace(kPolynomial, c, edge, normalize(middle + to)));
    return addLine(outline, q - p);
}

// The generic strategy (section 4.6): within its azimuths the arc is no further from the centre than its farther end, and
// the tangent in the middle of the circle there bounds it. Where a lens bends lines either way, not their chord but the
// circle of their nearest place bounds them inside.
SHARED_FN ShapeOutline addSector(ShapeOutline outline, int model, const real c[kRadialTerms], real edge, real slack,
                                 real3 from, real3 to, real2 p, real2 q) {
    real far = max(length(p), length(q));
    real near = min(length(p), length(q));
    real2 left = shapeUnit(p);
    real2 right = shapeUnit(q);
    real cosine = dot(left, right);
    if (cosine < -0.5 || near < 0.01 * far) {
        outline = addPlace(outline, real2(-far, -far));
        outline = addPlace(outline, real2(far, -far));
        outline = addPlace(outline, real2(far, far));
        return addPlace(outline, real2(-far, far));
    }
    outline.reach = max(outline.reach, 4.0 * (kShapeRounding + slack) * (far / near) * max(far, 1.0));
    real stretched = far / sqrt(0.5 * (1.0 + cosine));
    outline = addPlace(outline, left * stretched);
    outline = addPlace(outline, right * stretched);
    if (model != kPolynomial) return outline;
    real nearest = min(shapeRadius(c, edge, max(nearestOnArc(from, to) - kShapeRounding, 0.0)), near);
    outline = addPlace(outline, left * nearest);
    return addPlace(outline, right * nearest);
}

// Tight, or by the generic strategy, for up to four corners.
SHARED_FN ShapeOutline outlineOf(int model, const real c[kRadialTerms], real edge, real margin, bool generic,
                                 SeenPolygon seen) {
    ShapeOutline outline;
    outline.points = 0;
    outline.sides = 0;
    outline.reach = 0.0;
    outline.area = 0.0;
    outline.girth = 0.0;
    real3 sum = real3(0.0, 0.0, 0.0);
    for (int i = 0; i < seen.count; ++i) {
        outline = addPlace(outline, shapePlace(model, c, edge, seen.corners[i]));
        sum += seen.corners[i];
    }
    real volume = 0.0;
    for (int i = 0; i < seen.count; ++i)
        volume += dot(cross(seen.corners[i], seen.corners[i + 1 < seen.count ? i + 1 : 0]), sum);
    outline.turn = volume < 0.0 ? 1.0 : -1.0;

    real slack = seen.slack;
    for (int i = 0; i < seen.count; ++i) {
        int next = i + 1 < seen.count ? i + 1 : 0;
        real3 from = seen.corners[i];
        real3 to = seen.corners[next];
        real2 p = outline.places[i];
        real2 q = outline.places[next];
        real across = length(to - from);
        real along = length(to + from);
        if (across < kShapeRounding) continue;
        // The arc between almost opposite directions is known as well as their sum, or not at all.
        real doubt = along < 1.0 ? (0.4 * kShapeRounding + 3.0 * seen.slack) / max(along, 1e-20) : 0.0;
        slack = max(slack, doubt > 0.1 ? kShapeNowhere : doubt);
        if (doubt > 0.1) continue;

        real2 middle = shapePlace(model, c, edge, shapeDirection(from + to));
        outline.area += 0.5 * shapeCross(p, q) + shapeCross(middle - p, q - middle) * (2.0 / 3.0);
        outline.girth += length(q - p);
        real3 normal = cross(from, to);
        real inside = dot(normal, sum);
        if (generic && (model == kPolynomial || inside * normal.z <= 0.0 || abs(inside) <= kShapeRounding)) {
            outline = addSector(outline, model, c, edge, seen.slack, from, to, p, q);
        } else if (model == kPolynomial) {
            outline = addSamples(outline, c, edge, from, to, p, q);
        } else if (inside * normal.z > 0.0 && abs(inside) > kShapeRounding) {
            // The axis is on the other side, and nothing of the arc is in front of its chord.
            outline = addLine(outline, q - p);
        } else {
            outline = addBulge(outline, model, c, edge, from, to, p, q);
        }
    }
    outline.area = abs(outline.area);
    // Beyond twice its radius it covers the disc from anywhere.
    real doubt = (kShapeRounding + slack) * shapeScale(model, c, edge);
    outline.reach = margin + min(outline.reach + doubt, 2.5 * abs(shapePlace(model, c, edge, real3(1.0, 0.0, 0.0)).x));
    return outline;
}

// How far the outline goes in the direction `side`, of length one.
SHARED_FN real outlineReach(ShapeOutline outline, real2 side) {
    real most = dot(side, outline.places[0]);
    for (int i = 1; i < outline.points; ++i) most = max(most, dot(side, outline.places[i]));
    return most + outline.reach;
}

// The area that the margin and the roundings leave at least.
SHARED_FN real leastArea(ShapeOutline outline) {
    return outline.area + outline.reach * (outline.girth + 4.0 * outline.reach);
}

// ---- Shapes around it --------------------------------------------------------------------------------------------

SHARED_FN ShapePolygon noShape() {
    ShapePolygon shape;
    shape.count = 0;
    shape.area = kShapeNoArea;
    return shape;
}

// Within one line for each side, if these go once around; otherwise no shape.
SHARED_FN ShapePolygon polygonAround(ShapeOutline outline) {
    ShapePolygon shape = noShape();
    if (outline.sides < 3) return shape;
    bool past = false;
    for (int i = 0; i < outline.sides; ++i) {
        real2 here = outline.outward[i];
        real2 next = outline.outward[i + 1 < outline.sides ? i + 1 : 0];
        if (shapeCross(here, next) * outline.turn < 1e-4) return shape;
        bool beyond = shapeCross(outline.outward[0], here) * outline.turn < 0.0;
        if (past && !beyond) return shape;
        past = beyond;
    }

    // Along a line from its point nearest to the first place: an error that grows there stays on the line.
    for (int i = 0; i < outline.sides; ++i) {
        real2 here = outline.outward[i];
        real2 next = outline.outward[i + 1 < outline.sides ? i + 1 : 0];
        real2 along = real2(-here.y, here.x);
        real2 start = outline.places[0] + here * (outlineReach(outline, here) - dot(here, outline.places[0]));
        shape.corners[i] = start + along * ((outlineReach(outline, next) - dot(next, start)) / dot(next, along));
    }
    shape.count = outline.sides;
    shape.area = 0.0;
    for (int i = 2; i < shape.count; ++i)
        shape.area += 0.5 * abs(shapeCross(shape.corners[i - 1] - shape.corners[0],
                                           shape.corners[i] - shape.corners[0]));
    return shape;
}

SHARED_FN ShapePolygon boxAround(ShapeOutline outline, real2 along) {
    real2 across = real2(-along.y, along.x);
    real left = -outlineReach(outline, -along);
    real right = outlineReach(outline, along);
    real low = -outlineReach(outline, -across);
    real high = outlineReach(outline, across);
    ShapePolygon box;
    box.count = 4;
    box.corners[0] = along * left + across * low;
    box.corners[1] = along * right + across * low;
    box.corners[2] = along * right + across * high;
    box.corners[3] = along * left + across * high;
    box.area = (right - left) * (high - low);
    return box;
}

// The least box with a side along an axis or along one of the polygon's.
SHARED_FN ShapePolygon leastBox(ShapeOutline outline) {
    ShapePolygon least = boxAround(outline, real2(1.0, 0.0));
    for (int i = 0; i < outline.sides; ++i) {
        ShapePolygon box = boxAround(outline, outline.outward[i]);
        if (box.area < least.area) least = box;
    }
    return least;
}

// The less of both, of no more than `most` triangles (two or more).
SHARED_FN ShapePolygon leastShape(ShapeOutline outline, int most) {
    ShapePolygon shape = polygonAround(outline);
    if (shape.count > most + 2) shape = noShape();
    if (shape.area < 1.25 * leastArea(outline)) return shape;
    ShapePolygon box = leastBox(outline);
    if (box.area < shape.area) return box;
    return shape;
}

SHARED_FN BoundingTriangles addFan(BoundingTriangles triangles, ShapePolygon shape) {
    for (int i = 2; i < shape.count; ++i) {
        triangles.corners[3 * triangles.count] = shape.corners[0];
        triangles.corners[3 * triangles.count + 1] = shape.corners[i - 1];
        triangles.corners[3 * triangles.count + 2] = shape.corners[i];
        ++triangles.count;
    }
    return triangles;
}

SHARED_FN BoundingTriangles noTriangles() {
    BoundingTriangles triangles;
    triangles.count = 0;
    triangles.before = 0;
    triangles.cut = real3(0.0, 0.0, 0.0);
    return triangles;
}

// The plane through the axis, seen as a straight line, that halves the polygon's azimuths: through a corner if one is
// in the middle third of them.
SHARED_FN real3 cutThroughAxis(SeenPolygon seen, ShapeAzimuths azimuths) {
    real middle = 0.5 * (azimuths.least + azimuths.most);
    real nearest = (azimuths.most - azimuths.least) / 6.0;
    real2 line = shapeTurned(azimuths.towards, middle);
    for (int i = 0; i < seen.count; ++i) {
        real off = abs(shapeAzimuth(azimuths.towards, seen.corners[i]) - middle);
        if (off < nearest) {
            nearest = off;
            line = shapeUnit(real2(seen.corners[i].x, seen.corners[i].y));
        }
    }
    return real3(-line.y, line.x, 0.0);
}

// Around what is seen of the triangle ahead (angle at most `edge` and a quarter turn), pushed out by `margin`: one
// polygon where that fits, otherwise one on either side of a line from the centre.
SHARED_FN BoundingTriangles triangleBounds(int model, const real coefficients[kRadialTerms], real edge, real margin,
                                           real3 a, real3 b, real3 c) {
    BoundingTriangles whole = noTriangles();
    SeenPolygon seen = seenAhead(edge, a, b, c);
    if (seen.count == 0) return whole;
    ShapeOutline outline = outlineOf(model, coefficients, edge, margin, false, seen);
    ShapePolygon shape = leastShape(outline, 4);
    whole = addFan(whole, shape);
    whole.before = whole.count;
    if (shape.area < 1.25 * leastArea(outline)) return whole;

    ShapeAzimuths azimuths = azimuthsOf(seen);
    if (!azimuths.beside) return whole;
    BoundingTriangles cut = noTriangles();
    cut.cut = cutThroughAxis(seen, azimuths);
    SeenPolygon left = cutPolygon(seen, cut.cut);
    SeenPolygon right = cutPolygon(seen, -cut.cut);
    if (left.count == 0 || right.count == 0) return whole;
    ShapePolygon leftShape = leastShape(outlineOf(model, coefficients, edge, margin, false, left), 3);
    ShapePolygon rightShape =
        leastShape(outlineOf(model, coefficients, edge, margin, false, right), 6 - leftShape.count);
    if (leftShape.count + rightShape.count > 8 || leftShape.area + rightShape.area > 0.8 * shape.area) return whole;
    cut = addFan(cut, leftShape);
    cut.before = cut.count;
    return addFan(cut, rightShape);
}

SHARED_FN BoundingQuad quadOf(ShapePolygon box) {
    BoundingQuad quad;
    quad.count = 1;
    for (int i = 0; i < 4; ++i) quad.corners[i] = box.corners[i];
    return quad;
}

SHARED_FN BoundingQuad noQuad() {
    BoundingQuad quad;
    quad.count = 0;
    return quad;
}

// The same as one rectangle.
SHARED_FN BoundingQuad quadBounds(int model, const real coefficients[kRadialTerms], real edge, real margin, real3 a,
                                  real3 b, real3 c) {
    SeenPolygon seen = seenAhead(edge, a, b, c);
    if (seen.count == 0) return noQuad();
    return quadOf(leastBox(outlineOf(model, coefficients, edge, margin, false, seen)));
}

// By the generic strategy, with sides along the axes.
SHARED_FN BoundingQuad genericBounds(int model, const real coefficients[kRadialTerms], real edge, real margin, real3 a,
                                     real3 b, real3 c) {
    SeenPolygon seen = seenAhead(edge, a, b, c);
    if (seen.count == 0) return noQuad();
    ShapeOutline outline = outlineOf(model, coefficients, edge, margin, true, seen);
    return quadOf(boxAround(outline, real2(1.0, 0.0)));
}

// ---- Behind ------------------------------------------------------------------------------------------------------

SHARED_FN BoundingTriangles addQuad(BoundingTriangles triangles, real2 a, real2 b, real2 c, real2 d) {
    ShapePolygon shape;
    shape.count = 4;
    shape.area = 0.0;
    shape.corners[0] = a;
    shape.corners[1] = b;
    shape.corners[2] = c;
    shape.corners[3] = d;
    triangles = addFan(triangles, shape);
    triangles.before = triangles.count;
    return triangles;
}

// The azimuths by the radii from `inner` to `outer`, all around by one or two trapezoids.
SHARED_FN BoundingTriangles sectorBounds(ShapeAzimuths azimuths, real inner, real outer, real reach) {
    BoundingTriangles triangles = noTriangles();
    int parts = azimuths.most - azimuths.least > 1.0 ? 2 : 1;
    real spread = (azimuths.most - azimuths.least) / real(2 * parts);
    real near = max(inner - reach, 0.0);
    real far = (outer + reach) / cos(spread);
    for (int i = 0; i < parts; ++i) {
        real start = azimuths.least + real(2 * i) * spread;
        real2 left = shapeTurned(azimuths.towards, start);
        real2 right = shapeTurned(azimuths.towards, i + 1 < parts ? start + 2.0 * spread : azimuths.most);
        real2 middle = shapeTurned(azimuths.towards, start + spread);
        real2 push = real2(-middle.y, middle.x) * (reach / cos(spread));
        real2 pushLeft = i == 0 ? -push : real2(0.0, 0.0);
        real2 pushRight = i + 1 == parts ? push : real2(0.0, 0.0);
        triangles = addQuad(triangles, left * near + pushLeft, left * far + pushLeft, right * far + pushRight,
                            right * near + pushRight);
    }
    return triangles;
}

// Around what is seen of it behind (angle from a quarter turn to `edge`): a sector of the ring, or the whole disc if
// the backward axis is in the triangle.
SHARED_FN BoundingTriangles ringBounds(int model, const real coefficients[kRadialTerms], real edge, real margin,
                                       real3 a, real3 b, real3 c) {
    if (edge <= kShapeQuarterTurn) return noTriangles();
    SeenPolygon seen = cutPolygon(seenTriangle(a, b, c), real3(0.0, 0.0, 1.0));
    real least = edge;
    for (int i = 0; i < seen.count; ++i) least = min(least, shapeAngle(seen.corners[i]));
    real doubt = kShapeRounding + seen.slack;
    if (seen.count == 0 || least - doubt >= edge) return noTriangles();

    real rim = radialRadius(model, coefficients, edge);
    // The terms of a polynomial may be larger than their sum.
    real size = model == kPolynomial ? rim + shapeScale(model, coefficients, edge) : rim;
    real reach = margin + kShapeRounding * size;
    ShapeAzimuths azimuths = azimuthsOf(seen);
    if (!azimuths.beside) {
        real side = rim + reach;
        return addQuad(noTriangles(), real2(-side, -side), real2(side, -side), real2(side, side), real2(-side, side));
    }
    real most = min(2.0 * kShapeQuarterTurn - nearestToAxis(seen, false), edge);
    least = max(least - doubt, kShapeQuarterTurn);
    return sectorBounds(azimuths, radialRadius(model, coefficients, least), radialRadius(model, coefficients, most),
                        reach);
}
