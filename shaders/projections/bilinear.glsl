// A cell between four corners: linear along each side, bilinear inside, and its exact inverse.

// The value at (s, t), both from 0 to 1, is origin + s alongS + t alongT + s t twist.
struct BilinearCell {
    real2 origin;
    real2 alongS;
    real2 alongT;
    real2 twist;
};

// From the values at (0, 0), (1, 0), (0, 1) and (1, 1).
SHARED_FN BilinearCell bilinearCell(real2 v00, real2 v10, real2 v01, real2 v11) {
    BilinearCell cell;
    cell.origin = v00;
    cell.alongS = v10 - v00;
    cell.alongT = v01 - v00;
    cell.twist = (v11 - v10) - (v01 - v00);
    return cell;
}

SHARED_FN real2 bilinearAt(BilinearCell cell, real2 st) {
    return cell.origin + st.x * cell.alongS + st.y * (cell.alongT + st.x * cell.twist);
}

SHARED_FN real cross2(real2 a, real2 b) { return a.x * b.y - a.y * b.x; }

// The determinant of the cell's derivative: negative where it shows its back.
SHARED_FN real bilinearDeterminant(BilinearCell cell, real2 st) {
    return cross2(cell.alongS + st.y * cell.twist, cell.alongT + st.x * cell.twist);
}

// Candidates for (s, t): every solution is among them. A candidate that is none (not finite, or off because
// the value lies beyond a fold) shows by the value that it has.
struct BilinearRoots {
    real2 first;
    real2 second;
};

// On the side that t cuts out of the cell, (value - origin - t alongT) is parallel to (alongS + t twist): a
// quadratic for t. Its roots are taken from the sum without cancellation, so that a parallelogram, where the
// leading coefficient vanishes, is no special case: the second root becomes infinite.
SHARED_FN BilinearRoots bilinearInverse(BilinearCell cell, real2 value) {
    real2 q = value - cell.origin;
    real a = cross2(cell.twist, cell.alongT);
    real b = cross2(q, cell.twist) + cross2(cell.alongS, cell.alongT);
    real c = cross2(q, cell.alongS);
    // Negative by rounding on a fold, and where there is no solution.
    real root = sqrt(max(b * b - 4.0 * a * c, 0.0));
    real sum = b < 0.0 ? b - root : b + root;
    real t1 = -2.0 * c / sum;
    real t2 = -0.5 * sum / a;
    real2 side1 = cell.alongS + t1 * cell.twist;
    real2 side2 = cell.alongS + t2 * cell.twist;
    BilinearRoots roots;
    roots.first = real2(dot(q - t1 * cell.alongT, side1) / dot(side1, side1), t1);
    roots.second = real2(dot(q - t2 * cell.alongT, side2) / dot(side2, side2), t2);
    return roots;
}
