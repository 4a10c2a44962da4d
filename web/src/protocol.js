/** The binary messages of `/v1/live`: a 16-byte little-endian header, then the encoded picture. */

/**
 * @typedef {object} FrameMessage
 * @property {number} seq The latest message that the picture shows.
 * @property {number} pass Refinement, from 0.
 * @property {number} passes How many there will be.
 * @property {number} width
 * @property {number} height
 * @property {number} format
 * @property {Uint8Array<ArrayBuffer>} body
 */

const HEADER_BYTES = 16;
const MIME = new Map([[1, 'image/jpeg'], [2, 'image/png']]);
const RAW_RGBA8 = 3;

/** @param {ArrayBuffer} buffer @returns {FrameMessage} */
export function parseFrame(buffer) {
  if (buffer.byteLength < HEADER_BYTES) throw new Error(`a frame of ${buffer.byteLength} bytes has no header`);
  const view = new DataView(buffer);
  return {
    seq: view.getUint32(0, true),
    pass: view.getUint16(4, true),
    passes: view.getUint16(6, true),
    width: view.getUint16(8, true),
    height: view.getUint16(10, true),
    format: view.getUint8(12),
    body: new Uint8Array(buffer, HEADER_BYTES),
  };
}

/** True where no finer picture of the same scene follows. @param {FrameMessage} frame */
export const isFinal = ({ pass, passes }) => pass + 1 >= passes;

/** @param {FrameMessage} frame @returns {Promise<ImageBitmap>} */
export async function decodeFrame({ format, body, width, height }) {
  if (format === RAW_RGBA8) return createImageBitmap(new ImageData(new Uint8ClampedArray(body), width, height));
  const type = MIME.get(format);
  if (!type) throw new Error(`a frame of unknown format ${format}`);
  return createImageBitmap(new Blob([body], { type }));
}
