// The contract, compiled: what may be sent over the WebSocket and answered over HTTP.
import Ajv from 'ajv/dist/2020.js';
import { readFileSync } from 'node:fs';
import { parse } from 'yaml';

const folder = new URL('../../../contract/', import.meta.url);
const read = (name) => readFileSync(new URL(name, folder), 'utf8');

const ajv = new Ajv({ allErrors: true, strict: true, strictRequired: false, allowUnionTypes: true });
ajv.addVocabulary(['components']);
ajv.addSchema(JSON.parse(read('messages.schema.json')), 'messages.schema.json');
const { schemas } = parse(read('openapi.yaml')).components;
ajv.addSchema({ $id: 'openapi.yaml', components: { schemas } }, 'openapi.yaml', undefined, false);

function checker(reference) {
  const validate = ajv.compile({ $ref: reference });
  return (value) => {
    if (validate(value)) return;
    throw new Error(`${reference}: ${ajv.errorsText(validate.errors)} in ${JSON.stringify(value).slice(0, 400)}`);
  };
}

/** Each throws when the value is not as the contract has it. */
export const check = {
  fromServer: checker('messages.schema.json#/$defs/FromServer'),
  fromClient: checker('messages.schema.json#/$defs/FromClient'),
  status: checker('messages.schema.json#/$defs/Status'),
  vehicleLink: checker('messages.schema.json#/$defs/VehicleLink'),
  problem: checker('openapi.yaml#/components/schemas/Problem'),
  session: checker('openapi.yaml#/components/schemas/Session'),
  port: checker('openapi.yaml#/components/schemas/Port'),
  catalogue: checker('openapi.yaml#/components/schemas/Catalogue'),
  studyResult: checker('openapi.yaml#/components/schemas/StudyResult'),
};
