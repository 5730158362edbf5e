import type {
  CatalogueData,
  DliMessageInfo,
  EnumInfo,
  FromMavlinkRule,
  MavlinkFieldInfo,
  MavlinkMessageInfo,
  MavlinkValue,
  ToDliRule,
} from '../contract';

/** How a DLI field comes to its value: the rule that fills it, and the rules that tell the rule's facts. */
export interface Chain {
  toDli: ToDliRule;
  fromMavlink: FromMavlinkRule[]; // the best sources first
}

/** What is known of both protocols and of the mapping between them, ready to be looked up. */
export class Catalogue {
  private readonly mavlinkMessages: Map<number, MavlinkMessageInfo>;
  private readonly dliMessages: Map<number, DliMessageInfo>;
  private readonly enums: Record<string, EnumInfo>;
  private readonly rules: CatalogueData['rules'];

  constructor(data: CatalogueData) {
    this.mavlinkMessages = new Map(data.mavlink.messages.map((message) => [message.id, message]));
    this.dliMessages = new Map(data.dli.messages.map((message) => [message.number, message]));
    this.enums = data.mavlink.enums;
    this.rules = data.rules;
  }

  /** Nothing for a message of MAVLink 0.9: the same id may mean another one there, and its fields lie elsewhere. */
  mavlink(message: { id: number; version: number }): MavlinkMessageInfo | undefined {
    return message.version < 1 ? undefined : this.mavlinkMessages.get(message.id);
  }

  dli(number: number): DliMessageInfo | undefined {
    return this.dliMessages.get(number);
  }

  /** The label of a field's value: of an enumeration, or the flags of a bit mask; nothing where there is none. */
  labelOf(field: MavlinkFieldInfo, value: MavlinkValue): string | undefined {
    return typeof value === 'number' ? this.enumLabel(field.enum, value) : undefined;
  }

  /** The same by the enumeration's name. */
  enumLabel(name: string | undefined, value: number): string | undefined {
    const info = name === undefined ? undefined : this.enums[name];
    if (info === undefined) return undefined;
    if (!info.bitmask) return info.labels[value];
    const set = Object.entries(info.labels).filter(([bit]) => isSet(value, Number(bit)));
    return set.length === 0 ? undefined : set.map(([, label]) => label).join(' | ');
  }

  /** The ways in which a DLI field comes to its value. */
  chainsOf(number: number, field: string): Chain[] {
    return this.rules.to_dli
      .filter((rule) => rule.number === number && rule.field === field)
      .map((toDli) => ({
        toDli,
        fromMavlink: this.rules.from_mavlink
          .filter((rule) => toDli.facts.includes(rule.fact))
          .sort((a, b) => a.rank - b.rank),
      }));
  }

  /**
   * The DLI fields that a MAVLink field is the first source of; where it is nobody's first source, those it has some
   * part in.
   */
  targetsOf(message: string, field: string): ToDliRule[] {
    const using = this.rules.from_mavlink.filter((rule) => rule.message === message && rule.sources.includes(field));
    const leading = using.filter((rule) => rule.sources[0] === field);
    const facts = new Set((leading.length > 0 ? leading : using).map((rule) => rule.fact));
    return this.rules.to_dli.filter((rule) => rule.facts.some((fact) => facts.has(fact)));
  }

  /** The numbers of the DLI messages that tell something of this MAVLink message, ascending. */
  numbersFrom(message: string): number[] {
    const facts = new Set(this.rules.from_mavlink.filter((rule) => rule.message === message).map((rule) => rule.fact));
    const rules = this.rules.to_dli.filter((rule) => rule.facts.some((fact) => facts.has(fact)));
    return [...new Set(rules.map((rule) => rule.number))].sort((a, b) => a - b);
  }
}

// Bit masks may use more bits than the bitwise operators of JavaScript.
function isSet(value: number, bit: number): boolean {
  return bit > 0 && Math.floor(value / bit) % 2 === 1;
}
