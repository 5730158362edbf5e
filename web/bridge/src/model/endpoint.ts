export const baudRates = [9600, 19200, 38400, 57600, 115200, 230400, 460800, 500000, 921600, 1500000, 2000000] as const;

/** The endpoint of a serial port. */
export function serialEndpoint(device: string, baud: number): string {
  return `serial://${device}:${baud}`;
}
