// Texts inside a PNG file: chunks of the type iTXt before the pixels (PNG specification, 11.3.3).

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

function checksum(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = TABLE[(c ^ byte) & 0xff] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

function chunk(key, text) {
  // Keyword, no compression, no language, no translated keyword, text.
  const data = new TextEncoder().encode(`iTXt${key}\0\0\0\0\0${text}`);
  const bytes = new Uint8Array(data.length + 8);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length - 4);
  bytes.set(data, 4);
  view.setUint32(4 + data.length, checksum(data));
  return bytes;
}

/** The same PNG with texts after its header. */
export async function withTexts(blob, texts) {
  const bytes = new Uint8Array(await blob.arrayBuffer());
  const header = 33; // the signature and the header chunk
  const chunks = Object.entries(texts).map(([key, text]) => chunk(key, text));
  return new Blob([bytes.subarray(0, header), ...chunks, bytes.subarray(header)], { type: "image/png" });
}
