/** A schema with each shape that schemars writes, small enough to check by eye. */
import { readSchema } from '../../web/src/schema.js';

const number = (/** @type {number} */ initial, more = {}) => ({ type: 'number', default: initial, ...more });

export const SCHEMA = {
  type: 'object',
  properties: {
    time_s: { title: 'Time', 'x-unit': 's', ...number(0) },
    sun: { $ref: '#/$defs/Sun', description: 'The sun.', default: { position: { azimuth_deg: 180, elevation_deg: 35 }, disc: true } },
    air: { anyOf: [{ $ref: '#/$defs/Air' }, { type: 'null' }], default: { height_m: 100, ozone: { centre_m: 25 }, colour: [1, 2, 3], method: 'lut' } },
    fog: { anyOf: [{ $ref: '#/$defs/Ozone' }, { type: 'null' }], default: null },
    lens: { $ref: '#/$defs/Lens', default: { kind: 'narrow', fov_deg: 60 } },
    mist: { anyOf: [{ type: 'number', description: 'Grey.', minimum: 0, maximum: 0.1 }, { type: 'array', description: 'Red, green, blue.', items: { type: 'number', minimum: 0, maximum: 0.1 }, minItems: 3, maxItems: 3 }], default: 4e-6, title: 'Mist', 'x-unit': '1/m' },
    steps: { type: ['integer', 'null'], minimum: 4, maximum: 256, default: null },
    lamps: { type: 'array', items: { $ref: '#/$defs/Ozone' }, default: [] },
  },
  $defs: {
    Angles: { description: 'Azimuth and elevation.', type: 'object', properties: { azimuth_deg: { type: 'number', minimum: -360, maximum: 360 }, elevation_deg: { type: 'number', minimum: -90, maximum: 90 } } },
    Direction: { anyOf: [{ $ref: '#/$defs/Angles' }, { description: 'East, north, up; any length.', type: 'array', items: { type: 'number' }, minItems: 3, maxItems: 3 }] },
    Place: { anyOf: [{ $ref: '#/$defs/Direction' }, { description: 'Time.', type: 'object', properties: { time: { type: 'string' } } }] },
    Sun: { type: 'object', properties: { position: { $ref: '#/$defs/Place', default: { azimuth_deg: 180, elevation_deg: 35 } }, disc: { type: 'boolean', default: true } } },
    Ozone: { type: 'object', properties: { centre_m: number(25, { minimum: 0, maximum: 1e6 }) } },
    Air: {
      type: 'object',
      properties: {
        height_m: number(100),
        ozone: { anyOf: [{ $ref: '#/$defs/Ozone' }, { type: 'null' }], default: { centre_m: 25 } },
        colour: { type: 'array', items: { type: 'number' }, minItems: 3, maxItems: 3, default: [1, 2, 3] },
        method: { oneOf: [{ const: 'lut', type: 'string', description: 'Tables.' }, { const: 'nested', type: 'string' }], default: 'lut' },
      },
    },
    Lens: {
      oneOf: [
        { type: 'object', properties: { kind: { const: 'narrow' }, fov_deg: number(60) } },
        { type: 'object', properties: { kind: { const: 'round' }, fov_deg: number(180), mapping: { enum: ['a', 'b'], type: 'string', default: 'a' } } },
        { type: 'object', properties: { kind: { const: 'whole' } } },
      ],
    },
  },
};

export const root = readSchema(SCHEMA);
