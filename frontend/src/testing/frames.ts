/** Value frames as the server makes them; `wire/frames.ts` reads them. */

/** One frame with a whole number for each id: the bytes of a variable, little endian. */
export function frameOf(values: ReadonlyMap<number, bigint>, scan: number, timeNs: number): ArrayBuffer {
  const valuesAt = 24 + Math.ceil((values.size * 4) / 8) * 8;
  const buffer = new ArrayBuffer(valuesAt + values.size * 8 + 4);
  const view = new DataView(buffer);
  view.setUint8(0, 1);
  view.setUint32(4, values.size, true);
  view.setBigUint64(8, BigInt(scan), true);
  view.setBigInt64(16, BigInt(timeNs), true);
  [...values].forEach(([id, value], index) => {
    view.setUint32(24 + index * 4, id, true);
    view.setBigInt64(valuesAt + index * 8, BigInt.asIntN(64, value), true);
  });
  return buffer;
}
