/// Numbers as people read them.

/// The shortest decimal that reads back as the same binary32 number.
function shortestSingle(value) {
  for (let digits = 6; digits < 9; ++digits) {
    const near = Number(value.toPrecision(digits));
    if (Math.fround(near) === value) return String(near);
  }
  return String(Number(value.toPrecision(9)));
}

/// A number in full: it reads back as the same binary32 number where `isSingle`, or else as the same binary64 number.
export function textOf(value, isSingle) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "+∞" : "−∞";
  if (Object.is(value, -0)) return "-0";
  return isSingle ? shortestSingle(value) : String(value);
}

/// A number rounded to so many digits.
export function short(value, digits = 5) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : textOf(value, false);
}

/// A number in full, or else with as many digits as there is room for; empty where there is room for none.
export function textWithin(value, isSingle, letters) {
  const text = textOf(value, isSingle);
  if (text.length <= letters || !Number.isFinite(value)) return text;
  for (let digits = Math.min(9, letters); digits > 0; --digits) {
    const rounded = short(value, digits);
    if (rounded.length <= letters) return rounded;
  }
  return "";
}

const buffer = new DataView(new ArrayBuffer(8));

/// The place of a binary32 number among all such numbers, −0 and +0 being one.
export function placeOfSingle(value) {
  buffer.setFloat32(0, value);
  const bits = buffer.getUint32(0);
  return bits < 0x80000000 ? bits : 0x80000000 - bits;
}

/// The place of a binary64 number among all such numbers.
export function placeOfDouble(value) {
  buffer.setFloat64(0, value);
  const bits = buffer.getBigUint64(0), sign = 1n << 63n;
  return bits < sign ? bits : sign - bits;
}

/// "1 pixel", "2 pixels"
export function counted(count, word) {
  return count.toLocaleString("en-GB") + " " + word + (count === 1 ? "" : "s");
}

/// As percentage() of lib/fathom/text/percentage.h.
export function percentage(part, whole) {
  const smaller = 100 * Math.min(part, whole - part) / whole;
  return (100 * part / whole).toFixed(smaller === 0 ? 0 : smaller < 0.1 ? -Math.floor(Math.log10(smaller)) : 1) + " %";
}
