// A small catalogue for tests: six MAVLink messages and four of the DLI, as Ponte's definitions have them.

/** Fields written as `name type offset [unit] [@enum]`, in the order of the definition. */
function mavlink(id, name, ...fields) {
  return {
    id,
    name,
    fields: fields.map((text) => {
      const [field, typeText, offset, ...rest] = text.split(' ');
      const [, type, length] = /^([a-z0-9]+?)(?:\[(\d+)\])?$/.exec(typeText);
      const unit = rest.find((word) => !word.startsWith('@'));
      const enumName = rest.find((word) => word.startsWith('@'))?.slice(1);
      return {
        name: field,
        type,
        offset: Number(offset),
        ...(length && { array_length: Number(length) }),
        ...(unit && { unit }),
        ...(enumName && { enum: enumName }),
      };
    }),
  };
}

const widths = { u: 'unsigned', s: 'signed', b: 'bam', t: 'text' };

/** Fields written as `number|name|type and width|scale unit`; a binary angle's scale follows from its width. */
function dli(number, name, presence_bytes, confidence, ...fields) {
  return {
    number,
    name,
    presence_bytes,
    confidence,
    fields: fields.map((text) => {
      const [fieldNumber, fieldName, kind, measure] = text.split('|');
      const type = widths[kind[0]];
      const width = Number(kind.slice(1));
      const [scale, unit] = (measure ?? '').split(' ');
      return {
        number: Number(fieldNumber),
        key: fieldName.toLowerCase().replaceAll(/[^a-z0-9]+/g, '_'),
        name: fieldName,
        type,
        width,
        ...(type === 'bam' && { scale: Math.PI / 2 ** (8 * width - 1), unit: 'rad' }),
        ...(scale && { scale: Number(scale), unit }),
      };
    }),
  };
}

const attitude = (source, fact, rule, unit, ...more) => ({
  message: 'ATTITUDE',
  sources: [source, ...more],
  fact,
  rule,
  unit,
  rank: 0,
  reference: 'mapping 1 #4000',
});
const position = (source, fact, rule, unit) => ({
  ...attitude(source, fact, rule, unit),
  message: 'GLOBAL_POSITION_INT',
});
const toDli = (number, field, fact, rule = "as is, in the field's scale", confidence = 'standard') => ({
  number,
  field,
  facts: [fact],
  rule,
  reference: `mapping 1 #${number}`,
  confidence,
});

export const catalogue = {
  mavlink: {
    messages: [
      mavlink(
        0,
        'HEARTBEAT',
        'type uint8 4 @MAV_TYPE',
        'autopilot uint8 5 @MAV_AUTOPILOT',
        'base_mode uint8 6 @MAV_MODE_FLAG',
        'custom_mode uint32 0',
        'system_status uint8 7',
        'mavlink_version uint8 8',
      ),
      mavlink(
        30,
        'ATTITUDE',
        'time_boot_ms uint32 0 ms',
        'roll float 4 rad',
        'pitch float 8 rad',
        'yaw float 12 rad',
        'rollspeed float 16 rad/s',
        'pitchspeed float 20 rad/s',
        'yawspeed float 24 rad/s',
      ),
      mavlink(
        33,
        'GLOBAL_POSITION_INT',
        'time_boot_ms uint32 0 ms',
        'lat int32 4 degE7',
        'lon int32 8 degE7',
        'alt int32 12 mm',
        'relative_alt int32 16 mm',
        'vx int16 20 cm/s',
        'vy int16 22 cm/s',
        'vz int16 24 cm/s',
        'hdg uint16 26 cdeg',
      ),
      mavlink(
        74,
        'VFR_HUD',
        'airspeed float 0 m/s',
        'groundspeed float 4 m/s',
        'heading int16 16 deg',
        'throttle uint16 18 %',
        'alt float 8 m',
        'climb float 12 m/s',
      ),
      mavlink(
        147,
        'BATTERY_STATUS',
        'id uint8 32',
        'battery_function uint8 33',
        'type uint8 34',
        'temperature int16 8 cdegC',
        'voltages uint16[10] 10 mV',
        'current_battery int16 30 cA',
        'current_consumed int32 0 mAh',
        'energy_consumed int32 4 hJ',
        'battery_remaining int8 35 %',
      ),
      mavlink(253, 'STATUSTEXT', 'severity uint8 0', 'text char[50] 1'),
    ],
    enums: {
      MAV_TYPE: { bitmask: false, labels: { 1: 'MAV_TYPE_FIXED_WING', 2: 'MAV_TYPE_QUADROTOR' } },
      MAV_AUTOPILOT: { bitmask: false, labels: { 3: 'MAV_AUTOPILOT_ARDUPILOTMEGA', 12: 'MAV_AUTOPILOT_PX4' } },
      MAV_MODE_FLAG: {
        bitmask: true,
        labels: {
          1: 'MAV_MODE_FLAG_CUSTOM_MODE_ENABLED',
          8: 'MAV_MODE_FLAG_GUIDED_ENABLED',
          128: 'MAV_MODE_FLAG_SAFETY_ARMED',
        },
      },
    },
  },
  dli: {
    messages: [
      dli(
        3002,
        'Vehicle Operating States',
        3,
        'standard',
        '1|Time Stamp|u5|0.001 s',
        '2|Commanded Altitude|s3|0.02 m',
        '10|Power Level|s1|1 %',
        '12|Current Propulsion Energy Level|u2|0.0016 %',
        '17|AV State|u1',
      ),
      dli(
        4000,
        'Inertial States',
        3,
        'standard',
        '1|Time Stamp|u5|0.001 s',
        '2|Latitude|b4',
        '3|Longitude|b4',
        '4|Altitude|s3|0.02 m',
        '5|Altitude Type|u1',
        '6|U_Speed|s2|0.05 m/s',
        '7|V_Speed|s2|0.05 m/s',
        '8|W_Speed|s2|0.05 m/s',
        '9|U_Accel|s2|0.005 m/s^2',
        '10|V_Accel|s2|0.005 m/s^2',
        '11|W_Accel|s2|0.005 m/s^2',
        '12|Roll|b2',
        '13|Pitch|b2',
        '14|Heading|b2',
        '15|Roll Rate|s2|0.005 rad/s',
        '16|Pitch Rate|s2|0.005 rad/s',
        '17|Turn Rate|s2|0.005 rad/s',
        '18|Magnetic Variation|b2',
      ),
      dli(
        16000,
        'Subsystem Status Alert',
        2,
        'inferred',
        '1|Time Stamp|u5|0.001 s',
        '3|Priority|u1',
        '5|Subsystem ID|u1',
        '10|Type|u1',
        '11|Alert ID|s4',
        '12|Text|t80',
        '13|Persistence|s1|1 s',
      ),
      dli(16002, 'Heartbeat Message', 1, 'single_source', '1|Time Stamp|u5|0.001 s'),
    ],
  },
  rules: {
    from_mavlink: [
      attitude('roll', 'roll', 'rad', 'rad'),
      attitude('pitch', 'pitch', 'rad', 'rad'),
      attitude('yaw', 'heading', 'rad', 'rad'),
      attitude(
        'rollspeed',
        'roll_rate',
        'p + tan(pitch) (q sin(roll) + r cos(roll)); nothing near the vertical',
        'rad/s',
        'pitchspeed',
        'yawspeed',
        'roll',
        'pitch',
      ),
      attitude(
        'pitchspeed',
        'pitch_rate',
        'q cos(roll) - r sin(roll); nothing near the vertical',
        'rad/s',
        'yawspeed',
        'roll',
        'pitch',
      ),
      position('lat', 'latitude', 'degE7 to rad; nothing at 0, 0: no position yet', 'rad'),
      position('lon', 'longitude', 'degE7 to rad; nothing at 0, 0: no position yet', 'rad'),
      position('alt', 'altitude_msl', 'mm / 1000; nothing without a position', 'm'),
      position('vx', 'north_speed', 'cm/s / 100; nothing without a position', 'm/s'),
      position('vy', 'east_speed', 'cm/s / 100; nothing without a position', 'm/s'),
      position('vz', 'down_speed', 'cm/s / 100; nothing without a position', 'm/s'),
      {
        message: 'BATTERY_STATUS',
        sources: ['battery_remaining', 'id'],
        fact: 'energy_level',
        rule: '%; nothing at -1: not known, and from other batteries than the first',
        unit: '%',
        rank: 0,
        reference: 'mapping 1 #3002',
      },
      {
        message: 'STATUSTEXT',
        sources: ['text', 'severity'],
        fact: 'alert',
        rule: 'text, and severity as condition',
        unit: '',
        rank: 0,
        reference: 'mapping 1 Alerts',
      },
    ],
    to_dli: [
      toDli(4000, 'roll', 'roll'),
      toDli(4000, 'pitch', 'pitch'),
      toDli(4000, 'heading', 'heading'),
      toDli(4000, 'roll_rate', 'roll_rate'),
      toDli(4000, 'pitch_rate', 'pitch_rate'),
      toDli(4000, 'latitude', 'latitude'),
      toDli(4000, 'longitude', 'longitude'),
      toDli(4000, 'altitude', 'altitude_msl'),
      toDli(4000, 'altitude_type', 'altitude_msl', 'constant'),
      toDli(4000, 'u_speed', 'north_speed'),
      toDli(4000, 'v_speed', 'east_speed'),
      toDli(4000, 'w_speed', 'down_speed'),
      toDli(3002, 'current_propulsion_energy_level', 'energy_level'),
      toDli(16000, 'text', 'alert', 'as is', 'inferred'),
    ],
  },
};

/** The part of MAVLink's checksum that depends on the message. */
export const crcExtra = { 0: 50, 30: 39, 33: 104, 74: 20, 147: 154, 253: 83 };
