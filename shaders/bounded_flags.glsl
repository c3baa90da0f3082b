// What bounded.geom tells bounded.frag of a triangle and of a shape around a part of it. Shapes overlap; their parts do not.

const uint SEEN_FROM_BEHIND = 1u;
const uint BELOW_CUT = 2u;        // the part is what lies below the plane of `cut`, otherwise what does not
const uint BEHIND_THE_LENS = 4u;  // more than a quarter turn off the axis, otherwise less
