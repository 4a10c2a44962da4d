/** The field that fits a node of the schema. */
import { booleanField, choiceField, textField } from './choice.js';
import { groupField } from './group.js';
import { listField } from './list.js';
import { bandsField, numberField, numbersField } from './number.js';
import { optionalField } from './optional.js';
import { variantField } from './variant.js';

/** @type {Record<import('../schema.js').Node['type'], (context: import('./row.js').Context, pointer: string, node: import('../schema.js').Node) => import('./row.js').Field>} */
const FIELDS = {
  object: groupField,
  number: numberField,
  numbers: numbersField,
  bands: bandsField,
  list: listField,
  choice: choiceField,
  boolean: booleanField,
  text: textField,
  variant: variantField,
};

/** @param {import('./row.js').Context} context @param {string} pointer @param {import('../schema.js').Node} node */
export const createField = (context, pointer, node) =>
  node.nullable && node.type !== 'object' ? optionalField(context, pointer, node, FIELDS[node.type]) : FIELDS[node.type](context, pointer, node);
